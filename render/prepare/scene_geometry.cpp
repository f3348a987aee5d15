#include "render/prepare/scene_geometry.h"

#include <memory>
#include <utility>

namespace boule {

namespace {

/// One tree, or each of them as a part.
Geometry geometry_of(const PackedSpheres& packed, const std::vector<Plane>& planes) {
  const auto tree_over = [](const PackedTree& of, const std::vector<Plane>& beside) {
    return Geometry(of.tree, static_cast<std::size_t>(of.count), beside);
  };
  if (packed.trees.empty()) return {std::vector<Sphere>(), planes};
  if (packed.trees.size() == 1) return tree_over(packed.trees.front(), planes);
  std::vector<GeometryPart> parts;
  for (const PackedTree& tree : packed.trees)
    parts.push_back({std::make_shared<const Geometry>(tree_over(tree, {})), {}, {}});
  return Geometry::of_parts(std::move(parts), planes);
}

/// All but the capsules.
Geometry without_capsules(Scene& scene, const std::optional<std::vector<ShownGroup>>& groups,
                          const ParallelFor& parallel_for) {
  if (scene.packed) return geometry_of(*scene.packed, scene.planes);
  if (!groups) {
    return {std::move(scene.spheres), scene.planes, Structure::automatic, parallel_for};
  }
  const auto tree_over = [&](std::vector<Sphere>& spheres) {
    return std::make_shared<const Geometry>(std::move(spheres), std::vector<Plane>(),
                                            Structure::bvh, parallel_for);
  };
  std::vector<GeometryPart> parts;
  parts.reserve(groups->size() + 1);
  if (!scene.spheres.empty()) parts.push_back({tree_over(scene.spheres), {}, {}});
  std::vector<std::shared_ptr<const Geometry>> trees(scene.groups.size());
  for (const ShownGroup& shown : *groups) {
    auto& tree = trees[shown.group];
    if (!tree) tree = tree_over(scene.groups[shown.group].spheres);
    parts.push_back({tree, shown.transform, shown.material});
  }
  return Geometry::of_parts(std::move(parts), scene.planes);
}

}  // namespace

Geometry geometry_of(Scene& scene, const std::optional<std::vector<ShownGroup>>& groups,
                     const ParallelFor& parallel_for) {
  Geometry geometry = without_capsules(scene, groups, parallel_for);
  geometry.add_capsules(scene.capsules, parallel_for);
  return geometry;
}

}  // namespace boule
