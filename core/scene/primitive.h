#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/math/vec.h"

namespace boule {

/// What is wrong with one field of one thing: "radius", "must be above 0, is -1". All the
/// find_problem() take any values, NaN and infinite ones, too few and too many; they throw
/// std::bad_alloc, and nothing else.
struct Problem {
  std::string field;
  std::string message;
};

/// A sphere of positive radius; `material` indexes Scene::materials.
struct Sphere {
  Vec3f center;
  float radius = 1;
  std::uint32_t material = 0;
};

/// An infinite plane through `point`; `normal` (any length but 0) points to its outside.
struct Plane {
  Vec3f point;
  Vec3f normal{0, 1, 0};
  std::uint32_t material = 0;
};

/// True if a sphere by itself has no Problem. Short and inline: there may be millions.
inline bool is_valid(const Sphere& sphere) {
  const auto& [x, y, z] = sphere.center;
  const float radius = sphere.radius;
  // x - x is 0, or NaN where x is not finite: one comparison for four numbers.
  const float zero = (x - x) + (y - y) + (z - z) + (radius - radius);
  return zero == 0 && radius > 0;
}

/// The first Problem of a sphere or plane by itself (finite numbers, radius > 0, normal != 0).
std::optional<Problem> find_problem(const Sphere& sphere);
std::optional<Problem> find_problem(const Plane& plane);

}  // namespace boule
