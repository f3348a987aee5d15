#include "render/files/scene_file/toml/toml_objects.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/scene/instances.h"
#include "render/files/file/float32.h"
#include "render/files/file/nearest_name.h"
#include "render/files/file/sphere_room.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/npy/npy_reader.h"
#include "render/files/scene_file/toml/toml_color_map.h"
#include "render/files/scene_file/toml/toml_entities.h"
#include "render/files/scene_file/toml/toml_particle_style.h"
#include "render/memory/scene_memory.h"

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

/// Subtracts the point from which the group of an instance is counted, where the group is shown.
void count_from(const Vec3d& group_origin, TomlTable& table, Instance& instance) {
  if (group_origin == Vec3d{}) return;
  Vec3d translate;
  table.read("translate", translate);
  Similarity by = transform_of(instance);
  by.shift = translate;
  const Vec3d shown = by.apply(group_origin) - table.origin();
  const auto x = to_float32(shown.x), y = to_float32(shown.y), z = to_float32(shown.z);
  if (!x || !y || !z) return table.report("translate", "is too large for a 32-bit float");
  instance.translate = {*x, *y, *z};
}

/// Ids follow the order in the file, of all of them together.
template <class Tables>
void sort_by_place(std::vector<Tables>& all) {
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    const TextPlace p = a.table.place(), q = b.table.place();
    return std::tie(p.line, p.column) < std::tie(q.line, q.column);
  });
}

Status append(const NpySpheres& request, std::vector<Sphere>& spheres,
              const ParallelFor& parallel_for) {
  return append_spheres(request, spheres, parallel_for);
}
Status append(const NpyCapsules& request, std::vector<Capsule>& capsules,
              const ParallelFor& parallel_for) {
  return append_capsules(request, capsules, parallel_for);
}

/// A primitive with this radius.
template <class Primitive>
Primitive of_radius(float radius) {
  Primitive primitive;
  primitive.radius = radius;
  return primitive;
}

/// Reports what asks for outlines around groups where each object has its own.
void refuse_groups(TomlTable& table, const ParticleSpheres& particles) {
  if (!particles.has_groups() || !table.has("outline_by")) return;
  table.report("outline_by",
               "is for particles of the scene itself, in fewer than 16777216 spheres: expected "
               "\"object\"");
}

}  // namespace

ObjectTables object_tables(TomlTable& table) {
  ObjectTables tables;
  tables.planes = table.tables("plane");
  tables.instances = table.tables("instance");
  auto& all = tables.spheres;
  constexpr std::array keys{"sphere", "spheres", "particles"};  // in the order of Source
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto source = static_cast<ObjectTables::Source>(i);
    for (TomlTable& one : table.tables(keys[i])) all.push_back({std::move(one), source});
  }
  sort_by_place(all);
  for (const bool are_many : {false, true}) {
    for (TomlTable& one : table.tables(are_many ? "capsules" : "capsule"))
      tables.capsules.push_back({std::move(one), are_many});
  }
  sort_by_place(tables.capsules);
  return tables;
}

void TomlObjects::read_materials(std::vector<TomlTable> tables) {
  for (std::uint32_t id = 0; id < scene_.materials.size(); ++id)
    material_ids_.emplace(scene_.materials[id].name, id);
  for (TomlTable& table : tables) {
    const auto id = static_cast<std::uint32_t>(scene_.materials.size());
    if (!material_ids_.emplace(table.name(), id).second)
      table.report("type", "the packed scene has a material of this name already");
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

template <class Owner>
void TomlObjects::read_spheres(std::vector<ObjectTables::Spheres>& tables, Owner& owner) {
  for (auto& [table, source, particles] : tables) {
    switch (source) {
      case ObjectTables::Source::sphere:
        read_sphere(table, owner.spheres);
        break;
      case ObjectTables::Source::spheres:
        read_bulk(table, owner.spheres);
        break;
      case ObjectTables::Source::particles:
        add_particles(table, particles, owner);
        break;
    }
  }
}

void TomlObjects::load_particles(ObjectTables& tables, bool may_stream) {
  for (auto& [table, source, particles] : tables.spheres) {
    if (source != ObjectTables::Source::particles) continue;
    const std::uint32_t material = colorable_material_of(table, "material");
    const std::uint32_t ghosts = ghost_material_of(table, material);
    particles = read_particles(table, {material, ghosts}, options_, may_stream);
    if (!particles) return;
    notes_.insert(notes_.end(), particles->notes.begin(), particles->notes.end());
    facts_.push_back(particles->facts);
  }
}

/// Makes spheres and capsules of particles, and lets go of these.
template <class Owner>
void TomlObjects::add_particles(TomlTable& table, std::optional<TomlParticles>& particles,
                                Owner& owner) {
  if (!particles || !error_.status()) return;
  if (particles->source) {
    source_ = particles->source;
    source_->set_origin(table.origin());
    return;
  }
  std::vector<Sphere>& spheres = owner.spheres;
  ParticleSpheres& made = *particles->spheres;
  const auto fewest = options_.fewest_shared.value_or(ParticleSpheres::fewest_shared);
  if (made.shares_images(fewest) && &spheres == &scene_.spheres) {
    add_images(table, std::move(made));
    return particles.reset();
  }
  make_room(spheres, made.size());
  const std::size_t before = spheres.size();
  OutlineGroups* const groups =
      std::is_same_v<Owner, Scene> && made.has_groups() ? &scene_.outline_groups : nullptr;
  if (groups == nullptr) refuse_groups(table, made);
  if (auto done = made.append_capsules_to(owner.capsules, table.origin(), groups); !done)
    table.report("file", done.error().message);
  if (groups != nullptr) {
    if (auto done = made.append_groups_to(*groups, before); !done)
      table.report("outline_by", done.error().message);
  }
  if (auto done = std::move(made).append_to(spheres, table.origin(), options_.parallel_for);
      !done) {
    spheres.resize(before);
    table.report("file", done.error().message);
  }
  particles.reset();
}

/// Shows images of particles as instances of a group.
void TomlObjects::add_images(TomlTable& table, ParticleSpheres particles) {
  refuse_groups(table, particles);
  Group group{"images of " + table.path(), {}, {}, {}, {}};
  const CellImages images = particles.images();
  particles.append_lines_to(scene_.capsules, table.origin());
  for (const Status& done :
       {particles.append_boundary_to(scene_.spheres, table.origin()),
        particles.append_boundary_capsules_to(scene_.capsules, table.origin())}) {
    if (!done) return table.report("file", done.error().message);
  }
  if (auto done = particles.append_first_capsules_to(group.capsules, table.origin()); !done) {
    return table.report("file", done.error().message);
  }
  if (auto done = std::move(particles).append_first_image_to(group.spheres, table.origin(),
                                                             options_.parallel_for);
      !done) {
    return table.report("file", done.error().message);
  }
  const auto index = static_cast<std::uint32_t>(scene_.groups.size());
  scene_.groups.push_back(std::move(group));
  for (std::size_t image = 0; image < images.size(); ++image) {
    const Vec3f shift = vec_cast<float>(images.shift(image));
    scene_.instances.push_back({index, shift, {}, 1, {}});
  }
}

void TomlObjects::read_sphere(TomlTable& table, std::vector<Sphere>& spheres) {
  spheres.push_back(read_checked<Sphere>(table));
}

/// Appends primitives in memory, whose materials are those of the scene that have their names.
template <class Arrays, class Primitive>
void TomlObjects::add_arrays(TomlTable& table, const Arrays& arrays,
                             std::vector<Primitive>& primitives) {
  std::vector<std::uint32_t> ids;
  for (const std::string& name : arrays.materials) {
    const auto found = material_ids_.find(name);
    if (found == material_ids_.end()) {
      return table.report("material", "unknown material " + quote(name));
    }
    ids.push_back(found->second);
  }
  const MaterialRef common = ids.empty() ? colored_material_of(table) : MaterialRef();
  if (ids.empty()) ids.push_back(common.index());
  table.finish({"file"});
  const std::uint32_t last = *std::max_element(ids.begin(), ids.end());
  if (arrays.has_colors && last >= MaterialRef::max_colored) {
    return table.report("material", "is not one of the first " +
                                        std::to_string(MaterialRef::max_colored) +
                                        " of the scene: those can be given colours");
  }
  if (!error_.status()) return;
  const std::size_t before = primitives.size();
  if (auto done = arrays.append_to(primitives, table.origin(), options_.parallel_for); !done) {
    return table.report("file", done.error().message);
  }
  for (Primitive& one : std::span(primitives).subspan(before)) {
    MaterialRef& ref = one.material;
    const std::uint32_t id = ids[std::min<std::size_t>(ref.index(), ids.size() - 1)];
    ref = ref.has_color()      ? MaterialRef::colored(id, ref.color())
          : common.has_color() ? common
                               : MaterialRef(id);
  }
}

template <class Primitive>
void TomlObjects::read_bulk(TomlTable& table, std::vector<Primitive>& primitives) {
  if (const auto* arrays = find_arrays<Primitive>(table))
    return add_arrays(table, *arrays, primitives);
  std::string name;
  NpyPrimitives<Primitive> request;
  table.read_file_name("file", name);
  if (table.has("radius")) table.read("radius", request.radius.emplace());
  request.material = colored_material_of(table);
  const SphereColors colors = read_sphere_colors(table);
  table.finish({"file"});
  if (request.radius) table.check(find_problem(of_radius<Primitive>(*request.radius)));
  if (colors.any()) colorable_material_of(table, "material");
  if (!error_.status()) return;
  request.path = table.file_path(name);
  request.origin = table.origin();
  const std::size_t before = primitives.size();
  if (auto done = append(request, primitives, options_.parallel_for); !done) {
    return table.report("file", quote(name) + ": " + done.error().message);
  }
  if (colors.any()) color_bulk(table, colors, request.path, std::span(primitives).subspan(before));
}

template <class Primitive>
void TomlObjects::color_bulk(TomlTable& table, const SphereColors& colors, const std::string& path,
                             std::span<Primitive> primitives) {
  auto mapped = color_spheres(table, colors, materials_of(primitives), options_);
  if (!mapped) return;
  const char* const column = std::is_same_v<Primitive, Sphere> ? "column 3" : "column 6";
  facts_.push_back({.table = table.path(),
                    .file = path,
                    .format = "npy",
                    .particles = primitives.size(),
                    .spheres = primitives.size(),
                    .radius_source = table.has("radius") ? "the key radius" : column});
  facts_.back().colors.scale = std::move(mapped->scale);
  facts_.back().own = std::move(mapped->own);
  if (!mapped->note.empty()) notes_.push_back(std::move(mapped->note));
}

/// All but spheres, of a scene or a group. A floor is darker than what stands on it.
template <class Owner>
void TomlObjects::read_others(ObjectTables& tables, Owner& owner) {
  default_ = &default_plane_material_;
  for (TomlTable& one : tables.planes) owner.planes.push_back(read_checked<Plane>(one));
  default_ = &default_material_;
  for (auto& [table, are_many] : tables.capsules) {
    if (are_many) {
      read_bulk(table, owner.capsules);
    } else {
      owner.capsules.push_back(read_checked<Capsule>(table));
    }
  }
}

void TomlObjects::read_instances(std::vector<TomlTable>& tables, std::optional<std::size_t> group,
                                 const std::vector<Vec3d>& origins,
                                 std::vector<Instance>& instances) {
  for (TomlTable& table : tables) {
    Instance& instance = instances.emplace_back(read_checked<Instance>(table, {"group"}));
    if (instance.group < origins.size()) count_from(origins[instance.group], table, instance);
    instance_tables_.push_back({.group = group, .instance = instances.size() - 1, .table = table});
  }
}

void TomlObjects::start_groups(const std::vector<TomlTable>& tables) {
  for (const TomlTable& table : tables) {
    group_ids_.emplace(table.name(), static_cast<std::uint32_t>(scene_.groups.size()));
    scene_.groups.push_back({table.name(), {}, {}, {}, {}});
  }
}

void TomlObjects::read_group(std::size_t group, ObjectTables& tables,
                             const std::vector<Vec3d>& origins) {
  Group& own = scene_.groups[group];
  read_spheres(tables.spheres, own);
  read_others(tables, own);
  read_instances(tables.instances, group, origins, own.instances);
}

void TomlObjects::read_scene(ObjectTables& tables, const std::vector<Vec3d>& group_origins) {
  read_spheres(tables.spheres, scene_);
  read_others(tables, scene_);
  read_instances(tables.instances, std::nullopt, group_origins, scene_.instances);
}

void TomlObjects::check_instances() {
  if (!error_.status() || instance_tables_.empty()) return;
  if (const auto room = check_scene_memory(scene_); !room) {
    return error_.report(instance_tables_.front().table.place(), room.error().key,
                         room.error().message);
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
  return table.has("material") ? find_id(table, "material", material_ids_) : add(*default_);
}

MaterialRef TomlObjects::colored_material_of(TomlTable& table) {
  const std::uint32_t index = material_of(table);
  if (!table.has("color")) return index;
  const SrgbColor color = read_color_codes(table, "color");
  return MaterialRef::colored(colorable_material_of(table, "color"), color);
}

std::uint32_t TomlObjects::colorable_material_of(TomlTable& table, const char* key) {
  const std::uint32_t index = material_of(table);
  if (index < MaterialRef::max_colored) return index;
  table.report(key, "has a material that is not one of the first " +
                        std::to_string(MaterialRef::max_colored) +
                        " of the scene: those can be given colours");
  return 0;
}

/// The material of a table's ghosts; its own, if it has none.
std::uint32_t TomlObjects::ghost_material_of(TomlTable& table, std::uint32_t material) {
  const auto ghost = read_ghost(table, scene_.materials[material].material);
  if (!ghost) return material;
  const std::size_t index = scene_.materials.size();
  scene_.materials.push_back({table.path() + " ghosts", *ghost});
  if (index < MaterialRef::max_colored) return static_cast<std::uint32_t>(index);
  table.report("ghost", "needs one more material than can be given colours");
  return material;
}

std::uint32_t TomlObjects::add(DefaultMaterial& material) {
  if (!material.id) {
    material.id = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back({material.name, material.matte});
  }
  return *material.id;
}

}  // namespace boule
