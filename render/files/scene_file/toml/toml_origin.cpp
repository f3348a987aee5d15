#include "render/files/scene_file/toml/toml_origin.h"

#include <cmath>

#include "core/scene/instances.h"
#include "core/scene/number_text.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/npy/npy_reader.h"

namespace boule {
namespace {

SphereExtent of_sphere(TomlTable& table) {
  Vec3d center = vec_cast<double>(Sphere{}.center);
  auto radius = static_cast<double>(Sphere{}.radius);
  table.read("center", center);
  table.read("radius", radius);
  SphereExtent extent;
  extent.add(center, radius);
  return extent;
}

SphereExtent of_capsule(TomlTable& table) {
  Vec3d a, b;
  auto radius = static_cast<double>(Capsule{}.radius);
  table.read("a", a);
  table.read("b", b);
  table.read("radius", radius);
  SphereExtent extent;
  extent.add(a, radius);
  extent.add(b, radius);
  return extent;
}

template <class Spheres>
SphereExtent of_particles(const Spheres& particles) {
  if (particles.size() == 0) return {};
  const auto& [low, high] = particles.center_bounds();
  return {low, high, particles.smallest_radius(), SphereExtent::infinity};
}

/// The box around a box that is moved.
SphereExtent moved(const SphereExtent& extent, const Similarity& by) {
  const Vec3d middle = by.apply(extent.low * 0.5 + extent.high * 0.5);
  const Vec3d half = (extent.high - extent.low) * (0.5 * by.scale);
  const auto along = [&half](const Vec3d& row) {
    return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
  };
  const Vec3d around{along(by.row_x), along(by.row_y), along(by.row_z)};
  SphereExtent all;
  all.add(middle - around, extent.radius * by.scale);
  all.add(middle + around, extent.radius * by.scale);
  return all;
}

}  // namespace

TomlExtents::TomlExtents(const std::vector<TomlTable>& groups, std::vector<ObjectTables>& objects,
                         const SceneFileOptions& options)
    : objects_(objects), options_(options), known_(groups.size()) {
  for (const TomlTable& group : groups) ids_.emplace(group.name(), ids_.size());
}

SceneExtents TomlExtents::parts_of(ObjectTables& objects, std::size_t depth) {
  SceneExtents parts;
  for (ObjectTables::Spheres& spheres : objects.spheres) parts.push_back(of_spheres(spheres));
  for (auto& [table, are_many] : objects.capsules)
    parts.push_back(are_many ? of_file<Capsule>(table) : of_capsule(table));
  for (TomlTable& table : objects.instances) parts.push_back(of_instance(table, depth));
  return parts;
}

SphereExtent TomlExtents::of_spheres(ObjectTables::Spheres& spheres) {
  switch (spheres.source) {
    case ObjectTables::Source::sphere:
      return of_sphere(spheres.table);
    case ObjectTables::Source::spheres:
      return of_file<Sphere>(spheres.table);
    default:
      if (!spheres.particles) return {};
      return spheres.particles->source ? of_particles(spheres.particles->source->spheres())
                                       : of_particles(*spheres.particles->spheres);
  }
}

template <class Primitive>
SphereExtent TomlExtents::of_file(TomlTable& table) {
  if (const auto* arrays = find_arrays<Primitive>(table))
    return arrays->extent(options_.parallel_for);
  std::string name;
  NpyPrimitives<Primitive> request;
  table.read_file_name("file", name);
  if (table.has("radius")) table.read("radius", request.radius.emplace());
  if (!table.ok()) return {};
  request.path = table.beside_scene(name);
  return extent_of(request, options_.parallel_for);
}

SphereExtent TomlExtents::of_instance(TomlTable& table, std::size_t depth) {
  std::string group;
  Instance instance;
  Vec3d translate;
  table.read("group", group);
  table.read("rotate", instance.rotate);
  table.read("scale", instance.scale);
  table.read("translate", translate);
  const auto id = ids_.find(group);
  if (id == ids_.end()) return {};
  const SphereExtent& inside = of_group(id->second, depth + 1);
  if (inside.is_empty()) return {};
  Similarity by = transform_of(instance);
  by.shift = translate;
  return moved(inside, by);
}

/// A group that contains itself is refused later, and one that is nested too deep.
const SphereExtent& TomlExtents::of_group(std::size_t group, std::size_t depth) {
  static const SphereExtent nothing;
  if (known_[group]) return *known_[group];
  if (depth > max_nesting) return nothing;
  known_[group].emplace();
  SphereExtent all;
  for (const SphereExtent& part : parts_of(objects_[group], depth)) all.add(part);
  return known_[group].emplace(all);
}

std::optional<Vec3d> read_origin(TomlTable& root) {
  if (!root.has("origin")) return std::nullopt;
  if (root.has_text("origin")) {
    std::string text;
    root.read("origin", text);
    if (text != "auto") {
      root.report("origin", "expected \"auto\" or a point [x, y, z], got " + quote(text));
    }
    return std::nullopt;
  }
  Vec3d origin;
  root.read("origin", origin);
  for (const double x : {origin.x, origin.y, origin.z}) {
    if (!std::isfinite(x)) root.report("origin", "must be finite, is " + number_text(x));
  }
  return origin;
}

}  // namespace boule
