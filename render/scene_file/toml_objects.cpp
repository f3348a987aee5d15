#include "render/scene_file/toml_objects.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/scene/instances.h"
#include "render/memory/scene_memory.h"
#include "render/scene_file/nearest_name.h"
#include "render/scene_file/npy_reader.h"
#include "render/scene_file/toml_entities.h"

namespace boule {
namespace {

/// The number that `ids` has for the name under `key` of a table; an unknown name is reported.
std::uint32_t find_id(TomlTable& table, const char* key,
                      const std::map<std::string, std::uint32_t>& ids) {
  std::string name;
  table.read(key, name);
  const auto found = ids.find(name);
  if (found != ids.end()) return found->second;
  std::vector<std::string_view> names;
  names.reserve(ids.size());
  for (const auto& [known, id] : ids) names.push_back(known);
  table.report(key, std::string("unknown ") + key + " " + quote(name) + did_you_mean(name, names));
  return 0;
}

}  // namespace

ObjectTables object_tables(TomlTable& table) {
  ObjectTables tables;
  tables.planes = table.tables("plane");
  tables.instances = table.tables("instance");
  auto& all = tables.spheres;
  for (TomlTable& one : table.tables("sphere")) all.push_back({std::move(one), false});
  for (TomlTable& one : table.tables("spheres")) all.push_back({std::move(one), true});
  // Ids follow the order in the file, of [[sphere]] and [[spheres]] together.
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    const TextPlace p = a.table.place(), q = b.table.place();
    return std::tie(p.line, p.column) < std::tie(q.line, q.column);
  });
  return tables;
}

void TomlObjects::read_materials(std::vector<TomlTable> tables) {
  for (TomlTable& table : tables) {
    material_ids_.emplace(table.name(), static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back({table.name(), read_material(table)});
  }
}

template <class T>
T TomlObjects::read_checked(TomlTable& table, std::initializer_list<std::string_view> required) {
  T value;
  TomlFields(table, this).read(value);
  table.finish(required);
  table.check(find_problem(value));
  return value;
}

void TomlObjects::read_spheres(std::vector<ObjectTables::Spheres>& tables,
                               std::vector<Sphere>& spheres) {
  for (auto& [table, is_bulk] : tables) {
    is_bulk ? read_bulk(table, spheres) : read_sphere(table, spheres);
  }
}

void TomlObjects::read_sphere(TomlTable& table, std::vector<Sphere>& spheres) {
  spheres.push_back(read_checked<Sphere>(table));
}

void TomlObjects::read_bulk(TomlTable& table, std::vector<Sphere>& spheres) {
  std::string name;
  NpySpheres request;
  table.read_file_name("file", name);
  if (table.has("radius")) table.read("radius", request.radius.emplace());
  request.material = material_of(table);
  table.finish({"file"});
  if (request.radius) table.check(find_problem(Sphere{{}, *request.radius}));
  if (error_.status()) return;
  request.path = table.file_path(name);
  if (auto bad = append_spheres(request, spheres)) {
    table.report("file", quote(name) + ": " + bad->message);
  }
}

void TomlObjects::read_plane(TomlTable& table, std::vector<Plane>& planes) {
  planes.push_back(read_checked<Plane>(table));
}

void TomlObjects::read_instances(std::vector<TomlTable>& tables, std::optional<std::size_t> group,
                                 std::vector<Instance>& instances) {
  for (TomlTable& table : tables) {
    instances.push_back(read_checked<Instance>(table, {"group"}));
    instance_tables_.push_back({.group = group, .instance = instances.size() - 1, .table = table});
  }
}

void TomlObjects::start_groups(const std::vector<TomlTable>& tables) {
  for (const TomlTable& table : tables) {
    group_ids_.emplace(table.name(), static_cast<std::uint32_t>(scene_.groups.size()));
    scene_.groups.push_back({table.name(), {}, {}, {}});
  }
}

void TomlObjects::read_group(std::size_t group, TomlTable& table) {
  ObjectTables tables = object_tables(table);
  table.finish();
  Group& own = scene_.groups[group];
  read_spheres(tables.spheres, own.spheres);
  for (TomlTable& plane : tables.planes) read_plane(plane, own.planes);
  read_instances(tables.instances, group, own.instances);
}

void TomlObjects::read_scene(ObjectTables& tables) {
  read_spheres(tables.spheres, scene_.spheres);
  for (TomlTable& plane : tables.planes) read_plane(plane, scene_.planes);
  read_instances(tables.instances, std::nullopt, scene_.instances);
}

void TomlObjects::check_instances() {
  if (error_.status() || instance_tables_.empty()) return;
  if (const auto too_large = check_scene_memory(scene_)) {
    return error_.report(instance_tables_.front().table.place(), too_large->key,
                         too_large->message);
  }
  const auto bad = find_instance_problem(scene_);
  if (!bad) return;
  for (InstanceTable& one : instance_tables_) {
    if (one.group == bad->group && one.instance == bad->instance) one.table.check(bad->problem);
  }
}

std::uint32_t TomlObjects::group_of(TomlTable& table) {
  return table.has("group") ? find_id(table, "group", group_ids_) : 0;
}

std::uint32_t TomlObjects::material_of(TomlTable& table) {
  return table.has("material") ? find_id(table, "material", material_ids_) : default_material();
}

/// The material of objects that name none: a matte, added for the first of them.
std::uint32_t TomlObjects::default_material() {
  if (!default_id_) {
    default_id_ = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back({"default", Matte{}});
  }
  return *default_id_;
}

}  // namespace boule
