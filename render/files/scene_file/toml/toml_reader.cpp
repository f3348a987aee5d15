#include "render/files/scene_file/toml/toml_reader.h"

#include <algorithm>
#include <utility>

#include "core/scene/instances.h"
#include "core/scene/principal_pose.h"
#include "render/files/scene_file/toml/toml_camera.h"
#include "render/files/scene_file/toml/toml_camera_keys.h"
#include "render/files/scene_file/toml/toml_entities.h"
#include "render/files/scene_file/toml/toml_objects.h"
#include "render/files/scene_file/toml/toml_origin.h"
#include "render/files/scene_file/toml/toml_packed.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {
namespace {

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
  std::vector<ObjectTables> tables_in(std::vector<TomlTable>& groups);
  void choose_origins(const std::vector<TomlTable>& groups, std::vector<ObjectTables>& inside,
                      ObjectTables& objects);
  void check_packed(const ObjectTables& objects);
  void read_camera_table(TomlTable& table);
  void read_background_table(TomlTable& table);
  bool may_stream(const ObjectTables& objects, const std::vector<TomlTable>& groups,
                  std::optional<TomlTable>& camera) const;
  void choose_pose();
  void validate_whole();
  void describe(const std::vector<std::string>& notes);

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
  auto clips = root_.tables("clip");
  auto groups = root_.named_tables("group");
  packed_ = read_packed(root_, options_);
  auto inside = tables_in(groups);
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
  reader.load_particles(objects, may_stream(objects, groups, camera));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].finish();
    reader.load_particles(inside[i]);
  }
  choose_origins(groups, inside, objects);
  if (packed_) check_packed(objects);
  // From here on points are read.
  if (!lights.empty()) scene_.lights.clear();
  if (camera) read_camera_table(*camera);
  if (background) read_background_table(*background);
  for (TomlTable& light : lights) scene_.lights.push_back(read_light(light));
  if (!clips.empty()) scene_.clips.clear();
  for (TomlTable& clip : clips) scene_.clips.push_back(read_clip(clip));
  reader.read_scene(objects, loaded_.group_origins);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    reader.read_group(i, inside[i], loaded_.group_origins);
  }
  reader.check_instances();
  loaded_.particles = reader.facts();
  loaded_.source = reader.source();
  choose_pose();
  validate_whole();
  if (!error_.status()) return error_.status().error();
  describe(reader.notes());
  return std::move(loaded_);
}

/// The objects of each group, whose points are counted from its origin, once that is chosen.
std::vector<ObjectTables> TomlReader::tables_in(std::vector<TomlTable>& groups) {
  loaded_.group_origins.resize(groups.size());
  std::vector<ObjectTables> inside;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].set_origin(&loaded_.group_origins[i]);
    inside.push_back(object_tables(groups[i]));
  }
  return inside;
}

/// Sets what is told of a scene that was read; `notes` are those of its objects.
void TomlReader::describe(const std::vector<std::string>& notes) {
  loaded_.notes.insert(loaded_.notes.begin(), notes.begin(), notes.end());
  loaded_.notes.insert(loaded_.notes.end(), error_.notes().begin(), error_.notes().end());
  loaded_.data_files = error_.data_files();
  loaded_.origin = origin_;
  loaded_.group_origins.resize(scene_.groups.size(), origin_);  // images of particles
}

/// Each group has an origin of its own, which those who show it make up for.
void TomlReader::choose_origins(const std::vector<TomlTable>& groups,
                                std::vector<ObjectTables>& inside, ObjectTables& objects) {
  const auto given = read_origin(root_);
  TomlExtents extents(groups, inside, options_);
  SceneExtents all;
  if (!given && !options_.origin) all = extents.of(objects);
  origin_ = given ? *given : choose_origin(all, options_.origin, loaded_.notes);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    loaded_.group_origins[i] = choose_origin(extents.of(inside[i]));
  }
}

/// Whether a file of particles has all spheres, and the camera's pose is not found from them.
bool TomlReader::may_stream(const ObjectTables& objects, const std::vector<TomlTable>& groups,
                            std::optional<TomlTable>& camera) const {
  if (!options_.may_stream || packed_ || objects.spheres.size() != 1 || !groups.empty())
    return false;
  return !camera || !camera->has("pose");
}

/// Packed spheres are the only ones of a scene, and their points are counted from its origin.
void TomlReader::check_packed(const ObjectTables& objects) {
  for (const auto& [table, source, particles] : objects.spheres)
    error_.report(table.place(), table.path(), "a scene has no other spheres beside packed ones");
  if (root_.has("origin") && !root_.has_text("origin") && !(origin_ == packed_->origin))
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

void TomlReader::read_background_table(TomlTable& table) {
  scene_.ambient = {};
  scene_.backdrop.reset();
  scene_.background = read_background(table, scene_);
}

/// Molecules by themselves are looked at by their principal axes, and where particles have a cell,
/// z is up, in a picture whose camera does not say otherwise.
void TomlReader::choose_pose() {
  const auto& all = loaded_.particles;
  const bool are_free =
      !all.empty() && scene_.planes.empty() &&
      std::none_of(all.begin(), all.end(), [](const auto& facts) { return facts.axes_matter; });
  CameraFit& own = scene_.fit;
  if (are_free && !own.pose && !own.direction && !own.up) own.pose = FittedPose::principal;
  if (own.pose == FittedPose::principal && scene_.packed) {
    root_.table("camera")->report("pose", "packed spheres have none: give direction and up");
  }
  if (own.pose && !scene_.camera && error_.status())
    own = settled_fit(scene_, options_.parallel_for);
  const bool has_cell = std::any_of(
      all.begin(), all.end(), [](const ParticleFacts& facts) { return facts.cell.has_value(); });
  if (scene_.camera || scene_.fit.up || !has_cell) return;
  CameraFit fit = scene_.fit;
  fit.up = Vec3f{0, 0, 1};
  if (!find_problem(fit)) scene_.fit = fit;  // unless it looks along z
}

/// Checks what the readers of single tables do not: settings, `ambient`, the number of objects.
void TomlReader::validate_whole() {
  if (!error_.status()) return;
  if (scene_.packed && count_primitives(scene_).spheres != scene_.packed->count) {
    return error_.report(root_.place(), "instance",
                         "a scene has no other spheres beside packed ones");
  }
  const auto done = validate_all_but_primitives(scene_);
  if (done) return;
  const std::string section = done.error().key.substr(0, done.error().key.find('.'));
  const std::string field =
      done.error().key.substr(std::min(section.size() + 1, done.error().key.size()));
  if (auto table = field.empty() ? std::nullopt : root_.table(section)) {
    table->report(field, done.error().message);
  }
  error_.report(root_.place(), done.error().key, done.error().message);
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
  std::optional<double> frame = options.frame;
  if (frame) *frame += options.between;
  const auto motion = apply_camera_keys(std::get<TomlMembers>(root.data), frame, error);
  if (!error.status()) return error.status().error();
  return TomlReader(root, path, options, motion ? &*motion : nullptr).read();
}

}  // namespace boule
