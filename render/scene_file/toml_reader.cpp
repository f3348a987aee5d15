#include "render/scene_file/toml_reader.h"

#include <algorithm>
#include <utility>

#include "core/scene/instances.h"
#include "render/scene_file/toml_camera.h"
#include "render/scene_file/toml_camera_keys.h"
#include "render/scene_file/toml_entities.h"
#include "render/scene_file/toml_objects.h"
#include "render/scene_file/toml_origin.h"
#include "render/scene_file/toml_packed.h"
#include "render/scene_file/toml_table.h"

namespace boule {
namespace {

void add_extent(const ParticleSpheres& particles, ExactSpheres& spheres) {
  const auto& [low, high] = particles.center_bounds();
  SphereExtent extent{low, high};
  if (particles.size() != 0) extent.radius = particles.smallest_radius();
  spheres.extents.push_back(extent);
  const auto& cell = particles.cell();
  if (cell) spheres.cell_middle = cell->origin + (cell->a + cell->b + cell->c) * 0.5;
}

/// Turns the root table into a Scene: settings first, then materials, then the objects, which refer
/// to them.
class TomlReader {
 public:
  /// `motion` moves the camera from frame to frame; null: it stands still.
  TomlReader(const TomlValue& root, const std::string& path, const SceneFileOptions& options,
             const CameraMotion* motion)
      : options_(options),
        motion_(motion),
        error_(path, options.frame, options.data),
        root_(std::get<TomlMembers>(root.data), root.place, "", error_) {
    root_.set_origin(&origin_);
  }

  Result<LoadedScene> read();

 private:
  void check_schema();
  void choose_origin(const ObjectTables& objects);
  void check_packed(const ObjectTables& objects);
  void read_camera_table(TomlTable& table);
  void choose_up();
  void validate_whole();

  const SceneFileOptions& options_;
  const CameraMotion* motion_;
  Vec3d origin_;  ///< subtracted from all points, once it is known
  LoadedScene loaded_;
  Scene& scene_ = loaded_.scene;
  FirstError error_;
  TomlTable root_;
  std::optional<PackedPart> packed_;
};

Result<LoadedScene> TomlReader::read() {
  check_schema();
  auto image = root_.table("image"), camera = root_.table("camera");
  auto background = root_.table("background"), render = root_.table("render");
  auto materials = root_.named_tables("material");
  auto lights = root_.tables("light");
  auto objects = object_tables(root_);
  auto groups = root_.named_tables("group");
  packed_ = read_packed(root_, options_);
  for (TomlTable& group : groups) group.set_origin(nullptr);  // each has its own
  root_.has("origin");  // makes it known: it is read once the particles are there
  root_.finish();
  if (!root_.has("schema")) root_.report("schema", "missing key 'schema': write schema = 1");

  // What this file does not say comes from the packed one.
  if (packed_) scene_ = packed_->scene;
  if (image) scene_.image = read_image_settings(*image);
  if (render) scene_.render = read_render(*render);
  TomlObjects reader(scene_, error_, options_);
  reader.read_materials(std::move(materials));
  reader.start_groups(groups);
  reader.load_particles(objects);
  choose_origin(objects);
  if (packed_) check_packed(objects);
  // From here on points are read.
  if (!lights.empty()) scene_.lights.clear();
  if (camera) read_camera_table(*camera);
  if (background) {
    scene_.ambient = {};
    scene_.backdrop.reset();
    scene_.background = read_background(*background, scene_);
  }
  for (TomlTable& light : lights) scene_.lights.push_back(read_light(light));
  reader.read_scene(objects);
  for (std::size_t i = 0; i < groups.size(); ++i) reader.read_group(i, groups[i]);
  reader.check_instances();
  loaded_.particles = reader.facts();
  choose_up();
  validate_whole();
  if (error_.status()) return *error_.status();
  std::vector<std::string> notes = reader.notes();
  loaded_.notes.insert(loaded_.notes.begin(), notes.begin(), notes.end());
  loaded_.notes.insert(loaded_.notes.end(), error_.notes().begin(), error_.notes().end());
  loaded_.data_files = error_.data_files();
  loaded_.origin = origin_;
  return std::move(loaded_);
}

/// Groups keep their own point 0: what shows them is moved.
void TomlReader::choose_origin(const ObjectTables& objects) {
  // A text is "auto": any other was refused when the series chose its origin.
  if (options_.origin && (!root_.has("origin") || root_.has_text("origin"))) {
    origin_ = *options_.origin;
    return;
  }
  ExactSpheres spheres;
  for (const auto& table : objects.spheres) {
    if (table.particles) add_extent(table.particles->spheres, spheres);
    if (table.exact) spheres.extents.push_back(*table.exact);
  }
  if (spheres.extents.size() != 1) spheres.cell_middle.reset();
  origin_ = read_origin(root_, spheres, loaded_.notes);
}

/// Packed spheres are the only ones of a scene, and their points are counted from its origin.
void TomlReader::check_packed(const ObjectTables& objects) {
  for (const auto& [table, source, particles, exact] : objects.spheres)
    error_.report(table.place(), table.path(), "a scene has no other spheres beside packed ones");
  if (root_.has("origin") && !(origin_ == packed_->origin))
    root_.report("origin", "is not that of the packed scene, which need not be repeated");
  origin_ = packed_->origin;
}

void TomlReader::check_schema() {
  if (root_.is_empty()) root_.report("schema", "the scene is empty: begin with schema = 1");
  int schema = 1;
  root_.read("schema", schema);
  if (schema != 1) root_.report("schema", "must be 1, is " + std::to_string(schema));
}

void TomlReader::read_camera_table(TomlTable& table) {
  scene_.camera.reset();
  scene_.fit = {};
  scene_.distortion = read_distortion(table);
  if (const auto fit = read_camera_fit(table)) {
    if (motion_ != nullptr) table.report("key", "cannot stand beside 'fit'");
    scene_.fit = *fit;
    return;
  }
  scene_.camera = read_camera(table);
  if (motion_ != nullptr && table.ok()) check_camera_keys(*motion_, *scene_.camera, table);
}

/// Where particles have a cell, z is up in a picture whose camera does not say otherwise.
void TomlReader::choose_up() {
  const auto& all = loaded_.particles;
  const bool has_cell = std::any_of(
      all.begin(), all.end(), [](const ParticleFacts& facts) { return facts.cell.has_value(); });
  if (scene_.camera || scene_.fit.up || !has_cell) return;
  CameraFit fit = scene_.fit;
  fit.up = Vec3f{0, 0, 1};
  if (!find_problem(fit)) scene_.fit = fit;  // unless it looks along z
}

/// Checks what the readers of single tables do not: settings, `ambient`, the number of objects.
void TomlReader::validate_whole() {
  if (error_.status()) return;
  if (scene_.packed && count_primitives(scene_).spheres != scene_.packed->count) {
    return error_.report(root_.place(), "instance",
                         "a scene has no other spheres beside packed ones");
  }
  const auto bad = validate_all_but_primitives(scene_);
  if (!bad) return;
  const std::string section = bad->key.substr(0, bad->key.find('.'));
  const std::string field = bad->key.substr(std::min(section.size() + 1, bad->key.size()));
  if (auto table = field.empty() ? std::nullopt : root_.table(section)) {
    table->report(field, bad->message);
  }
  error_.report(root_.place(), bad->key, bad->message);
}

}  // namespace

Result<LoadedScene> read_toml(std::string_view text, const std::string& path,
                              const SceneFileOptions& options) {
  auto root = parse_toml(text, path);
  if (!root) return root.error();
  return read_toml_tree(std::move(root).value(), path, options);
}

Result<LoadedScene> read_toml_tree(TomlValue root, const std::string& path,
                                   const SceneFileOptions& options) {
  FirstError error(path);
  const auto motion = apply_camera_keys(std::get<TomlMembers>(root.data), options.frame, error);
  if (error.status()) return *error.status();
  return TomlReader(root, path, options, motion ? &*motion : nullptr).read();
}

}  // namespace boule
