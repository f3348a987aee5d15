#include "render/apps/cli/info/particle_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "render/apps/cli/info/camera_info.h"
#include "render/apps/job/options/shown_values.h"
#include "render/apps/job/particle_scene.h"
#include "render/files/particle_file/particle_file.h"
#include "render/frame/scheduler.h"
#include "render/prepare/default_camera.h"
#include "render/renderer/scene_hash.h"

namespace boule::cli {
namespace {

Json vector_info(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// Each with its number of particles, in the order of the file.
Json species_info(const TextColumn& species) {
  std::vector<std::size_t> counts(species.texts.size());
  for (const std::uint32_t index : species.indices) ++counts[index];
  Json list = Json::array();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    list.push_back({{"name", species.texts[i]}, {"count", counts[i]}});
  }
  return list;
}

/// Numbers with their range and how many of them are missing or infinite, texts with how many
/// different ones there are.
Json columns_info(const ParticleFrame& frame) {
  Json list = Json::array();
  for (const NumberColumn& column : frame.numbers) {
    Json json = {{"name", column.name}};
    const ColumnExtent extent = column_extent(column);
    if (extent.least <= extent.largest) {
      json.update({{"least", extent.least}, {"largest", extent.largest}});
    }
    if (extent.missing > 0) json["missing"] = extent.missing;
    if (extent.infinite > 0) json["infinite"] = extent.infinite;
    list.push_back(std::move(json));
  }
  for (const TextColumn& column : frame.texts) {
    list.push_back({{"name", column.name}, {"texts", column.texts.size()}});
  }
  return list;
}

Json cell_info(const ParticleCell& cell) {
  return {{"a", vector_info(cell.a)},
          {"b", vector_info(cell.b)},
          {"c", vector_info(cell.c)},
          {"origin", vector_info(cell.origin)},
          {"periodic", cell.periodic}};
}

/// The box of the positions.
Json positions_info(const std::vector<Vec3d>& positions) {
  if (positions.empty()) return nullptr;
  Vec3d low = positions.front(), high = low;
  for (const Vec3d& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {{"low", vector_info(low)}, {"high", vector_info(high)}};
}

/// What colours mean: of species by their names, of numbers by the map's range.
Json colors_info(const ParticleColors& colors) {
  if (colors.scale) {
    Json json = {{"by", colors.scale->by}, {"range", colors.scale->range}};
    if (colors.scale->missing > 0) json["missing"] = shown(colors.scale->nan_color);
    return json;
  }
  if (colors.species.empty()) return "of the file or the material";
  Json json = Json::object();
  for (const auto& species : colors.species) json[species.name] = shown(species.color);
  return json;
}

/// What `boule render` would choose.
Json picture_info(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  const ParticleFacts& facts = loaded.particles.front();
  Json json = {{"spheres", facts.spheres},
               {"bonds", facts.bonds},
               {"radius", facts.radius_source},
               {"color", colors_info(facts.colors)},
               {"origin", vector_info(loaded.origin)}};
  const Camera camera = default_camera(scene, scene.image.width, scene.image.height);
  json["camera"] = camera_info(camera, loaded.origin);
  json["hash"] = fmt::format("{:016x}", scene_hash(scene, Scheduler(0).parallel_for()));
  return json;
}

Json frame_info(const ParticleFrame& frame) {
  Json json = {{"particles", frame.size()}};
  if (frame.time) json["time"] = *frame.time;
  json["species"] = frame.species ? species_info(*frame.species) : Json::array();
  json["columns"] = columns_info(frame);
  json["cell"] = frame.cell ? cell_info(*frame.cell) : Json();
  json["bounds"] = positions_info(frame.positions);
  return json;
}

}  // namespace

Result<Json> particle_info(const std::string& path, const LookOptions& look,
                           std::optional<int> frame) {
  Scheduler scheduler(0);
  SceneFileOptions options;
  options.frame = frame;
  options.parallel_for = scheduler.parallel_for();
  auto made = load_particle_scene(path, look, options);
  if (!made) return made.error();
  const LoadedScene& loaded = made.value().loaded;
  const ParticleFacts& facts = loaded.particles.front();
  const auto read = read_all_columns(look, facts, options.parallel_for);
  if (!read) return read.error();
  Json json = {{"schema", 1},
               {"file", facts.file},
               {"format", facts.format},
               {"frames", facts.frames},
               {"frame", facts.frame}};
  json.update(frame_info(read.value()));
  json["picture"] = picture_info(loaded);
  json["notes"] = loaded.notes;
  json["warnings"] = loaded.warnings;
  return json;
}

}  // namespace boule::cli
