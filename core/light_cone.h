#pragma once

#include "core/math/ray.h"
#include "core/math/sobol.h"
#include "core/math/vec.h"

namespace boule {

/// A sphere as a point outside of it sees it: the cone of directions that meet it (Shirley, Wang,
/// Zimmerman, "Monte Carlo techniques for direct lighting calculations", 1996), chosen from evenly.
class LightCone {
 public:
  /// Of any numbers: without a radius, or with NaN, it is seen from nowhere; a negative radius
  /// counts as its size.
  LightCone(const Vec3d& point, const Vec3d& center, double radius);

  /// Per solid angle, of every direction that meets the sphere; 0 where the point is not outside.
  [[nodiscard]] double density() const { return density_; }

  /// A direction within the cone, of unit length; anything where the density is 0. The numbers lie
  /// in [0, 1).
  [[nodiscard]] Vec3d direction(const UnitPair& numbers) const;

  /// True if the sphere lies in this direction, of unit length, before `distance`.
  [[nodiscard]] bool meets(const Vec3d& direction, double distance) const;

  /// From the point along a direction within the cone as far as the sphere: not so far that the
  /// ray, whose direction is rounded to float, can meet the sphere itself. Anything where the
  /// density is 0.
  [[nodiscard]] Ray way(const Vec3d& direction) const;

 private:
  /// How far the sphere is along a line that passes its centre at the distance `aside`.
  [[nodiscard]] double distance_to(double aside) const;

  Vec3d point_;
  Vec3d axis_;
  double distance_;  ///< to the centre
  double radius_;
  double height_ = 0;  ///< 1 - the cosine of the cone's half angle
  double density_ = 0;
};

}  // namespace boule
