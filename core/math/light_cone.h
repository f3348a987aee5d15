#pragma once

#include "core/math/geometry.h"
#include "core/math/number.h"
#include "core/math/ray.h"
#include "core/math/sobol.h"
#include "core/math/vec.h"
#include "core/math/warp.h"

namespace boule {

/// A sphere as seen from a point outside: the cone of directions that meet it, from which
/// directions are drawn evenly (Shirley, Wang, Zimmerman, "Monte Carlo techniques for direct
/// lighting calculations", 1996). T is double, or lanes of it.
template <class T>
class LightConeOf {
 public:
  /// Takes any numbers: a sphere without a radius, or with NaN, is invisible; a negative radius
  /// counts by its absolute value.
  BOULE_INLINE LightConeOf(const Vec3<T>& point, const Vec3<T>& center, const T& radius)
      : radius_(radius) {
    const Vec3<T> to_center = center - point;
    distance_ = length(to_center);
    axis_ = to_center * (T(1.0) / distance_);
    const T sine = radius / distance_;
    height_ = sine * sine / (T(1.0) + sqrt(T(1.0) - sine * sine));  // no cancellation
    const Mask<T> outside = (radius < distance_) & (T(0.0) < height_);
    density_ = select(outside, cone_density(height_), T(0.0));
  }

  /// The density, per solid angle, of every direction that meets the sphere; 0 unless the point is
  /// outside.
  [[nodiscard]] BOULE_INLINE const T& density() const { return density_; }

  /// A direction within the cone, of unit length; undefined if the density is 0. The numbers lie in
  /// [0, 1).
  [[nodiscard]] BOULE_INLINE Vec3<T> direction(const UnitPairOf<T>& numbers) const {
    return direction_about(axis_, warp_to_cone(numbers.u, height_), numbers.v);
  }

  /// The distance that a ray may go along a direction within the cone while certainly missing the
  /// sphere itself, even if the direction is rounded to float. Undefined if the density is 0.
  [[nodiscard]] BOULE_INLINE T free_distance(const Vec3<T>& direction) const {
    // Rounding turns the direction by up to u, so the line passes the centre by up to u distance
    // nearer; twice that is used. The nearer it passes, the earlier it meets the sphere.
    const T aside = length(cross(direction, axis_) * distance_);
    const T nearest = positive(aside - T(2 * unit_roundoff) * distance_);
    return distance_to(nearest * nearest) * T(short_of_the_end);
  }

  /// True if the sphere lies in this direction, of unit length, before `distance`.
  [[nodiscard]] BOULE_INLINE Mask<T> meets(const Vec3<T>& direction, const T& distance) const {
    const Vec3<T> aside = cross(direction, axis_) * distance_;
    const T aside2 = dot(aside, aside), nearest = sqrt(aside2);
    return (T(0.0) < density_) & (T(0.0) < dot(direction, axis_)) & (aside2 <= radius_ * radius_) &
           (distance_to(nearest * nearest) < distance);
  }

 private:
  /// The distance along a line at which the sphere begins. `aside2`: the squared distance of the
  /// line from the centre.
  [[nodiscard]] BOULE_INLINE T distance_to(const T& aside2) const {
    return sqrt(positive(distance_ * distance_ - aside2)) -
           sqrt(positive(radius_ * radius_ - aside2));
  }

  Vec3<T> axis_;
  T distance_;  ///< to the centre
  T radius_;
  T height_;  ///< 1 - the cosine of the cone's half angle
  T density_;
};

using LightCone = LightConeOf<double>;

}  // namespace boule
