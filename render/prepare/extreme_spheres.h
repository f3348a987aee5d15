#pragma once

#include <span>
#include <vector>

#include "core/scene/packed_spheres.h"
#include "core/scene/primitive.h"

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

/// Some of packed spheres: among them are, for each of the measures, one for which it is least, or
/// all those for which it is within its rounding of that. Along axes of coordinates, and for the
/// radius, they are known; else it visits the nodes that may lead to such spheres.
std::vector<Sphere> extreme_spheres(const PackedSpheres& spheres,
                                    std::span<const SphereMeasure> measures);

}  // namespace boule
