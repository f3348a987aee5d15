#pragma once

#include <cmath>
#include <cstddef>

#include "core/math/vec.h"
#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"

namespace boule {

/// A sphere whose radius is the sum of two floats.
struct Ball {
  Vec3f center{};
  float radius = 1;
  float more = 0;
};

/// The sphere in a slot of a block. Its radius counts by its absolute value.
inline Ball ball_in(const SphereBlock& block, std::size_t k) {
  return {{block.center_x[k], block.center_y[k], block.center_z[k]}, std::fabs(block.radius[k])};
}

/// The distance of a point from a primitive's surface is negative inside. A ball and a capsule hold
/// their surface; a plane bounds the half-space behind it, and its normal points outside. Inputs
/// are taken as exact. Preconditions: primitives are valid; coordinates of points are at most
/// most_point_coordinate in size. Throw std::bad_alloc.

inline constexpr double most_point_coordinate = 1e150;

/// A distance that rounding has not decided, and how wrong it may be.
struct RoughDistance {
  double value, error;
};
RoughDistance rough_distance(const Ball& ball, const Vec3d& point);
RoughDistance rough_distance(const Capsule& capsule, const Vec3d& point);
RoughDistance rough_distance(const Plane& plane, const Vec3d& point);

/// The exact distance, rounded once, to the nearest double (of two the even one).
double find_distance(const Ball& ball, const Vec3d& point);
double find_distance(const Capsule& capsule, const Vec3d& point);
double find_distance(const Plane& plane, const Vec3d& point);

/// Whether the exact distance is at most `limit`, which is not NaN.
bool is_within(const Ball& ball, const Vec3d& point, double limit);
bool is_within(const Capsule& capsule, const Vec3d& point, double limit);
bool is_within(const Plane& plane, const Vec3d& point, double limit);

}  // namespace boule
