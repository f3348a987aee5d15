#include "render/apps/job/particle_scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/base/text.h"
#include "core/math/geometry.h"
#include "render/apps/job/options/look_choices.h"
#include "render/files/file/mapped_text.h"
#include "render/files/file/npy_header.h"
#include "render/files/packed/packed_file.h"
#include "render/files/particle_file/frame/other_formats.h"
#include "render/files/particle_file/particle_file.h"
#include "render/prepare/shown_extremes.h"

namespace boule {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool has_ending(std::string_view path, std::string_view ending) {
  if (path.size() < ending.size()) return false;
  path.remove_prefix(path.size() - ending.size());
  return std::equal(path.begin(), path.end(), ending.begin(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

bool has_named_fields(const std::string& npy) {
  auto file = InputFile::open(npy);
  if (!file) return false;
  const auto header = read_npy_header(file.value());
  return header && !header.value().fields.empty();
}

/// The name of the option that says this key of the scene: the key's last word, but for these.
std::string_view option_name(std::string_view key) {
  constexpr std::array<std::array<std::string_view, 2>, 4> others{
      {{"format", "input_format"}, {"by", "color"}, {"direction", "view"}, {"pose", "view"}}};
  const std::string_view word = key.substr(key.rfind('.') + 1);
  for (const auto& [last, name] : others) {
    if (word == last) return name;
  }
  return word;
}

/// The option of the command line that a key of the scene comes from, if it was given; else empty.
std::string option_of(std::string_view key, const LookOptions& look) {
  const std::string_view name = option_name(key);
  const LookOptions usual;
  std::string option;
  const auto compare = [&](const auto& row) {
    const bool is_given = !(look.*row.member == usual.*row.member);
    if (row.name == name && is_given) option = row.option();
  };
  std::apply([&](const auto&... row) { (compare(row), ...); }, look_choices());
  return option;
}

/// An error in the scene's text, which nobody has seen, as one about the options or the file.
Diagnostic explain(Diagnostic error, const std::string& shown_path, const std::string& path,
                   const LookOptions& look) {
  if (error.file != shown_path) return error;
  if (const std::string option = option_of(error.key, look); !option.empty()) {
    return Diagnostic::about(option, std::move(error.message));
  }
  if (error.message.starts_with("not valid TOML")) {
    return Diagnostic::in_file(path, "its name, or an option, is not UTF-8, as scenes are");
  }
  const std::string prefix = quote(path) + ": ";
  if (error.message.starts_with(prefix)) error.message.erase(0, prefix.size());
  return Diagnostic::in_file(path, std::move(error.message));
}

/// True for the endings of scenes: .toml, .nff, .npy, .boule.
bool is_scene_name(const std::string& path) {
  return is_packed_name(path) || has_ending(path, ".toml") || has_ending(path, ".nff") ||
         has_ending(path, ".npy");
}

}  // namespace

Diagnostic not_particles(const std::string& path, const std::string& option) {
  return Diagnostic::about(
      option, "is of particle files, and " + quote(path) + " is none by its name or content");
}

Result<LoadedScene> load_known(const std::string& path, const LookOptions& look,
                               const SceneFileOptions& options) {
  if (!look.first.empty()) return not_particles(path, look.first);
  if (is_scene_name(path)) return load_scene(path, options);
  if (has_ending(path, ".film")) {
    return Diagnostic::in_file(
        path, "is a film by its name, not a scene: boule merge makes a picture of films");
  }
  if (auto file = MappedText::open(path); !file) return file.error();
  return Diagnostic::in_file(
      path,
      "neither a scene nor particles by its name or content, expected .toml .nff .npy .boule or " +
          known_particle_endings() + advice_for(path));
}

ParticleFileOptions file_options_of(const LookOptions& look) {
  ParticleFileOptions options;
  options.format = look.format;
  options.columns = look.columns;
  options.water = look.water;
  options.topology = look.topology;
  return options;
}

Result<ParticleFrame> read_all_columns(const LookOptions& look, const ParticleFacts& facts,
                                       const ParallelFor& parallel_for) {
  ParticleFileOptions options = file_options_of(look);
  options.format = facts.format;
  for (;;) {
    auto file = ParticleFile::open(facts.file, options, parallel_for);
    if (!file) return file.error();
    auto read = file.value().read(static_cast<long>(facts.frame), parallel_for);
    // A strict reader tells columns of texts from those of numbers better.
    if (read || std::exchange(options.lenient, true)) return read;
  }
}

bool is_particle_input(const std::string& path, const LookOptions& look) {
  if (!look.format.empty()) return true;
  if (has_ending(path, ".npy")) return !look.first.empty() || has_named_fields(path);
  if (is_scene_name(path)) return false;
  return is_particle_name(path) || has_particle_content(path);
}

std::optional<double> lowest_along(const Vec3d& direction, const LoadedScene& loaded) {
  double lowest = infinity;
  const ShownExtremes extremes(loaded.scene, serial_for);
  extremes.runs({{normalize(direction), 1}})([&](SphereRun spheres) {
    for (const Sphere& sphere : spheres) {
      lowest = std::min(lowest, dot(vec_cast<double>(sphere.center), direction) -
                                    static_cast<double>(sphere.radius));
    }
  });
  return lowest == infinity ? std::nullopt : std::optional(lowest);
}

LookFloor floor_at(double lowest, const Vec3d& up, const Vec3d& origin) {
  // Rounded before the origin is added: so it is exact when the origin is subtracted again.
  const auto point = vec_cast<double>(vec_cast<float>(up * lowest));
  return {point + origin + Vec3d{}, up};  // 0 where it would be -0, which TOML cannot tell from 0
}

void add_floor(const LookFloor& floor, LoadedScene& loaded) {
  auto& materials = loaded.scene.materials;
  const auto named = std::find_if(materials.begin(), materials.end(), [](const NamedMaterial& one) {
    return one.name == floor_material;
  });
  const auto index = static_cast<std::uint32_t>(named - materials.begin());
  const Vec3d point = floor.point - loaded.origin;
  loaded.scene.planes.push_back({vec_cast<float>(point), vec_cast<float>(floor.up), index});
}

Result<ParticleScene> load_particle_scene(const std::string& path, const LookOptions& look,
                                          const SceneFileOptions& options,
                                          const std::optional<LookFloor>& floor) {
  // In the working directory, so that the names of files are as they were typed.
  const std::string shown_path = "the scene of a particle file";
  std::string text = look_scene(path, look, floor);
  auto loaded = load_scene_text(text, shown_path, options);
  if (!loaded) return explain(loaded.error(), shown_path, path, look);
  ParticleScene made{std::move(text), std::move(loaded).value(), floor};
  if (!look.floor || floor) return made;
  // Where the floor is shows only now. It is put into the scene as it would be read from the text:
  // particles are not read twice.
  const Vec3d up = normalize(vec_cast<double>(made.loaded.scene.fit.up.value_or(Vec3f{0, 1, 0})));
  const auto lowest = lowest_along(up, made.loaded);
  if (!lowest) return made;
  made.floor = floor_at(*lowest, up, made.loaded.origin);
  made.text = look_scene(path, look, made.floor);
  add_floor(*made.floor, made.loaded);
  return made;
}

}  // namespace boule
