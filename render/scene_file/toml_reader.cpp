#include "render/scene_file/toml_reader.h"

#include <algorithm>
#include <utility>

#include "render/scene_file/toml_camera.h"
#include "render/scene_file/toml_camera_keys.h"
#include "render/scene_file/toml_entities.h"
#include "render/scene_file/toml_objects.h"
#include "render/scene_file/toml_table.h"

namespace boule {
namespace {

/// Turns the root table into a Scene: settings first, then materials, then the objects, which refer
/// to them.
class TomlReader {
 public:
  /// `motion` moves the camera from frame to frame; null: it stands still.
  TomlReader(const TomlValue& root, const std::string& path, std::optional<int> frame,
             const CameraMotion* motion)
      : motion_(motion),
        error_(path, frame),
        root_(std::get<TomlMembers>(root.data), root.place, "", error_) {}

  Result<LoadedScene> read();

 private:
  void check_schema();
  void read_camera_table(TomlTable& table);
  void validate_whole();

  const CameraMotion* motion_;
  Scene scene_;
  FirstError error_;
  TomlTable root_;
};

Result<LoadedScene> TomlReader::read() {
  check_schema();
  auto image = root_.table("image"), camera = root_.table("camera");
  auto background = root_.table("background"), render = root_.table("render");
  auto materials = root_.named_tables("material");
  auto lights = root_.tables("light");
  auto objects = object_tables(root_);
  auto groups = root_.named_tables("group");
  root_.finish();
  if (!root_.has("schema")) root_.report("schema", "missing key 'schema': write schema = 1");

  if (image) scene_.image = read_image(*image);
  if (render) scene_.render = read_render(*render);
  if (camera) read_camera_table(*camera);
  if (background) scene_.background = read_background(*background, scene_.ambient);
  for (TomlTable& light : lights) scene_.lights.push_back(read_light(light));
  TomlObjects reader(scene_, error_);
  reader.read_materials(std::move(materials));
  reader.start_groups(groups);
  reader.read_scene(objects);
  for (std::size_t i = 0; i < groups.size(); ++i) reader.read_group(i, groups[i]);
  reader.check_instances();
  validate_whole();
  if (error_.status()) return *error_.status();
  return LoadedScene{std::move(scene_), {}, error_.data_files()};
}

void TomlReader::check_schema() {
  if (root_.is_empty()) root_.report("schema", "the scene is empty: begin with schema = 1");
  int schema = 1;
  root_.read("schema", schema);
  if (schema != 1) root_.report("schema", "must be 1, is " + std::to_string(schema));
}

void TomlReader::read_camera_table(TomlTable& table) {
  scene_.camera = read_camera(table, scene_.distortion);
  if (motion_ != nullptr && table.ok()) check_camera_keys(*motion_, *scene_.camera, table);
}

/// Checks what the readers of single tables do not: settings, `ambient`, the number of objects.
void TomlReader::validate_whole() {
  if (error_.status()) return;
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
                              std::optional<int> frame) {
  auto root = parse_toml(text, path);
  if (!root) return root.error();
  FirstError error(path);
  const auto motion = apply_camera_keys(std::get<TomlMembers>(root.value().data), frame, error);
  if (error.status()) return *error.status();
  return TomlReader(root.value(), path, frame, motion ? &*motion : nullptr).read();
}

}  // namespace boule
