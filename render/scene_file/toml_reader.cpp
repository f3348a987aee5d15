#include "render/scene_file/toml_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include "render/scene_file/nearest_name.h"
#include "render/scene_file/npy_reader.h"
#include "render/scene_file/toml_entities.h"
#include "render/scene_file/toml_table.h"

namespace boule {
namespace {

/// Turns the root table into a Scene: settings first, then materials, then what refers to them.
class TomlReader {
 public:
  TomlReader(const TomlValue& root, const std::string& path)
      : error_(path), root_(std::get<TomlMembers>(root.data), root.place, "", error_) {}

  Result<LoadedScene> read();

 private:
  /// A [[sphere]], or a [[spheres]] for a file of them.
  struct SphereTable {
    TomlTable table;
    bool is_bulk;
  };

  void check_schema();
  void read_materials(std::vector<TomlTable> tables);
  void read_spheres(std::vector<TomlTable> single, std::vector<TomlTable> bulk);
  void read_sphere(TomlTable& table);
  void read_bulk(TomlTable& table);
  void read_plane(TomlTable& table);
  std::uint32_t material_of(TomlTable& table);
  std::uint32_t default_material();
  void validate_whole();

  Scene scene_;
  FirstError error_;
  TomlTable root_;
  std::map<std::string, std::uint32_t> material_ids_;
  std::optional<std::uint32_t> default_id_;
};

Result<LoadedScene> TomlReader::read() {
  check_schema();
  auto image = root_.table("image"), camera = root_.table("camera");
  auto background = root_.table("background"), render = root_.table("render");
  auto materials = root_.named_tables("material");
  auto lights = root_.tables("light"), planes = root_.tables("plane");
  auto single = root_.tables("sphere"), bulk = root_.tables("spheres");
  root_.finish({"schema"});

  if (image) scene_.image = read_image(*image);
  if (render) scene_.render = read_render(*render);
  if (camera) scene_.camera = read_camera(*camera);
  if (background) scene_.background = read_background(*background, scene_.ambient);
  for (TomlTable& light : lights) scene_.lights.push_back(read_light(light));
  read_materials(std::move(materials));
  read_spheres(std::move(single), std::move(bulk));
  for (TomlTable& plane : planes) read_plane(plane);
  validate_whole();
  if (error_.status()) return *error_.status();
  return LoadedScene{std::move(scene_), {}};
}

void TomlReader::check_schema() {
  int schema = 1;
  root_.read("schema", schema);
  if (schema != 1) root_.report("schema", "must be 1, is " + std::to_string(schema));
}

void TomlReader::read_materials(std::vector<TomlTable> tables) {
  for (TomlTable& table : tables) {
    material_ids_.emplace(table.name(), static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back({table.name(), read_material(table)});
  }
}

void TomlReader::read_spheres(std::vector<TomlTable> single, std::vector<TomlTable> bulk) {
  std::vector<SphereTable> all;
  for (TomlTable& table : single) all.push_back({std::move(table), false});
  for (TomlTable& table : bulk) all.push_back({std::move(table), true});
  // Ids go by the order in the file, whichever of the two a table is.
  std::stable_sort(all.begin(), all.end(), [](const SphereTable& a, const SphereTable& b) {
    const TextPlace p = a.table.place(), q = b.table.place();
    return std::tie(p.line, p.column) < std::tie(q.line, q.column);
  });
  for (SphereTable& one : all) one.is_bulk ? read_bulk(one.table) : read_sphere(one.table);
}

void TomlReader::read_sphere(TomlTable& table) {
  Sphere sphere;
  table.read("center", sphere.center);
  table.read("radius", sphere.radius);
  sphere.material = material_of(table);
  table.finish();
  table.check(find_problem(sphere));
  scene_.spheres.push_back(sphere);
}

void TomlReader::read_bulk(TomlTable& table) {
  std::string name;
  NpySpheres request;
  table.read("file", name);
  if (table.has("radius")) table.read("radius", request.radius.emplace());
  request.material = material_of(table);
  table.finish({"file"});
  if (request.radius) table.check(find_problem(Sphere{{}, *request.radius}));
  if (error_.status()) return;
  request.path = (std::filesystem::path(error_.file()).parent_path() / name).string();
  if (auto bad = append_spheres(request, scene_.spheres)) {
    table.report("file", quote(name) + ": " + bad->message);
  }
}

void TomlReader::read_plane(TomlTable& table) {
  Plane plane;
  table.read("point", plane.point);
  table.read("normal", plane.normal);
  plane.material = material_of(table);
  table.finish();
  table.check(find_problem(plane));
  scene_.planes.push_back(plane);
}

std::uint32_t TomlReader::material_of(TomlTable& table) {
  if (!table.has("material")) return default_material();
  std::string name;
  table.read("material", name);
  const auto found = material_ids_.find(name);
  if (found != material_ids_.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [known, id] : material_ids_) names.push_back(known);
  table.report("material", "unknown material " + quote(name) + did_you_mean(name, names));
  return 0;
}

/// The material of objects that name none: a matte, added when the first of them comes.
std::uint32_t TomlReader::default_material() {
  if (!default_id_) {
    default_id_ = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back({"default", Matte{}});
  }
  return *default_id_;
}

/// What no single table shows: the settings, `ambient` and the sum of all.
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

Result<LoadedScene> read_toml(std::string_view text, const std::string& path) {
  const auto root = parse_toml(text, path);
  if (!root) return root.error();
  return TomlReader(root.value(), path).read();
}

}  // namespace boule
