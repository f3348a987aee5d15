#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/vec.h"

namespace boule {

/// The unit roundoff of float: the unit of every bound in the project.
inline constexpr double unit_roundoff = 0x1p-24;

/// The fraction of the way at which a ray to a point ends: its direction is rounded to float, so
/// the point itself is known only to that precision.
inline constexpr double short_of_the_end = 1 - 4 * unit_roundoff;

/// The id that means no source primitive, or no hit.
inline constexpr std::int32_t no_primitive = -1;

/// A bounded ray: the points org + t dir with tmin < t <= tmax (lecture "Rays"). dir may have any
/// length. Origins are double because secondary rays start on surfaces. Any numbers are allowed: a
/// ray with NaN, with an infinite origin or direction, without a direction, or without tmin < tmax
/// misses everything. Streams for kernels hold the ends as floats, rounded outward (RayBuffer).
struct Ray {
  Vec3d org;
  Vec3f dir;
  double tmin = 0;
  double tmax = std::numeric_limits<double>::infinity();
  std::int32_t source = no_primitive;  ///< primitive the ray leaves, or no_primitive
  /// The ray starts on the surface of `source`, a sphere or capsule, and goes to its inside.
  bool inside = false;
};

/// The largest float that is at most x, -inf included, and the smallest one that is at least x.
/// Infinity and NaN stay what they are.
inline float float_below(double x) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (x > double{largest}) return x == double{infinity} ? infinity : largest;
  if (x < -double{largest}) return -infinity;
  const auto nearest = static_cast<float>(x);
  return double{nearest} > x ? std::nextafter(nearest, -infinity) : nearest;
}
inline float float_above(double x) { return -float_below(-x); }

/// The part that many rays have in common, such as all primary rays of a camera.
enum class CommonPart { none, origin, direction };

/// The segment from `from` to `to` as a ray, without its ends: dir = to - from, and tmax is
/// short_of_the_end. If the far end lies on a surface that is tilted against the axes, segments
/// that graze it at sines below 1/4 may still hit it: rounding dir moves the end by up to u |dir|.
inline Ray segment(const Vec3d& from, const Vec3d& to) {
  Ray ray{from, vec_cast<float>(to - from)};
  ray.tmax = short_of_the_end;
  return ray;
}

/// The nearest hit of one ray: t in double, unrounded; a miss has t = inf and id = no_primitive.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  std::int32_t id = no_primitive;
  /// The slot of a sphere or a capsule in a Geometry; undefined for other hits.
  std::uint32_t slot = 0;
};

}  // namespace boule
