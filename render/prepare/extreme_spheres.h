#pragma once

#include <span>
#include <vector>

#include "core/scene/primitive.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {

/// A number that spheres have: direction . center - weight radius. Its direction has the length 1
/// and the weight is 0 or 1; or the direction is 0.
struct SphereMeasure {
  Vec3d direction;
  double weight;

  [[nodiscard]] double of(const Sphere& sphere) const;
  /// No sphere within a box has less.
  [[nodiscard]] double least_in(const Vec3d& low, const Vec3d& high) const;
};

/// Some spheres of a tree: among them are, for each of the measures, all those for which it is
/// within its rounding of the least one. It visits the nodes only that may lead to such spheres.
std::vector<Sphere> extreme_spheres(const Bvh& tree, std::span<const SphereMeasure> measures);

}  // namespace boule
