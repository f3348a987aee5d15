#pragma once

#include <cstdint>
#include <limits>

#include "core/math/vec.h"

namespace boule {

/// The unit roundoff of float: every bound in the project is counted in it.
inline constexpr double unit_roundoff = 0x1p-24;

/// A ray to a point ends at this share of the way: its direction is rounded to float, so the point
/// itself is only known to that.
inline constexpr double short_of_the_end = 1 - 4 * unit_roundoff;

/// No source primitive, or no hit.
inline constexpr std::int32_t no_primitive = -1;

/// A bounded ray: the points org + t dir with tmin < t <= tmax (lecture "Rays").
/// dir need not be of unit length. Origins are double because secondary rays start on surfaces. Any
/// numbers are a ray: with NaN, an infinite origin or direction, or without a direction it meets
/// nothing, and likewise where tmin < tmax does not hold.
struct Ray {
  Vec3d org;
  Vec3f dir;
  float tmin = 0;
  float tmax = std::numeric_limits<float>::infinity();
  std::int32_t source = no_primitive;  ///< primitive the ray leaves, or no_primitive
  /// The ray leaves `source`, a sphere, on its inside: from a point of its surface.
  bool inside = false;
};

/// What many rays have in common, such as all primary rays of a camera.
enum class CommonPart { none, origin, direction };

/// The segment from `from` to `to` as a ray, without its ends: dir = to - from, and tmax is
/// short_of_the_end. A surface that the far end lies on, if it is tilted against the axes, may
/// still be met by segments that graze it at sines below 1/4: rounding dir moves the end by up to
/// u |dir|.
inline Ray segment(const Vec3d& from, const Vec3d& to) {
  Ray ray{from, vec_cast<float>(to - from)};
  ray.tmax = static_cast<float>(short_of_the_end);
  return ray;
}

/// The nearest hit of one ray: t in double, unrounded; a miss has t = inf and id = no_primitive.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  std::int32_t id = no_primitive;
  std::uint32_t slot = 0;  ///< of a sphere in a Geometry: where it lies there; else anything
};

}  // namespace boule
