#pragma once

#include <optional>
#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "tests/oracle/big_float.h"

namespace boule::test {

/// The truth about rays and primitives: float inputs (and double origins) taken as exact, 1400
/// bits. The sign of the discriminant and the order of roots and bounds are exact. It knows nothing
/// of sources: a ray that leaves a surface is a ray like any other. Inputs: finite, dir not 0.

/// Where a line meets a primitive.
struct OracleHit {
  BigFloat t;                     ///< the first root with tmin < t <= min(tmax, FLT_MAX)
  std::optional<BigFloat> other;  ///< the other root of a sphere or capsule, live or not
};

/// Both ends of a line in a sphere; equal where it touches. Nothing where it misses.
struct OracleRoots {
  BigFloat enter, leave;
};
std::optional<OracleRoots> oracle_roots(const Ray& ray, const Sphere& sphere);

/// Nothing where the ray misses.
std::optional<OracleHit> oracle_hit(const Ray& ray, const Sphere& sphere);
std::optional<OracleHit> oracle_hit(const Ray& ray, const Plane& plane);
std::optional<OracleHit> oracle_hit(const Ray& ray, const Capsule& capsule);

/// The nearest of all, equal t: the lower id. Ids: spheres in order, then planes.
std::int32_t oracle_closest(const Ray& ray, std::span<const Sphere> spheres,
                            std::span<const Plane> planes);

/// |o + t d - c| - r, or the signed distance from the plane, for any t.
BigFloat oracle_residual(const Ray& ray, const Sphere& sphere, double t);
BigFloat oracle_residual(const Ray& ray, const Plane& plane, double t);
BigFloat oracle_residual(const Ray& ray, const Capsule& capsule, double t);

}  // namespace boule::test
