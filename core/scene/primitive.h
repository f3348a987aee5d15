#pragma once

#include <cstdint>
#include <optional>

#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/material_ref.h"
#include "core/scene/problem.h"

namespace boule {

/// A sphere of positive radius; `material` is one of Scene::materials, possibly in another colour.
struct Sphere {
  Vec3f center{};
  float radius = 1;
  MaterialRef material{};
};

template <>
inline constexpr auto fields<Sphere> = field_list("sphere",
                                                  field("center", &Sphere::center, rule::point),
                                                  field("radius", &Sphere::radius, rule::positive),
                                                  field("material", &Sphere::material,
                                                        rule::material));

/// An infinite plane through `point`; `normal` (any length but 0) points to its outside.
struct Plane {
  Vec3f point{};
  Vec3f normal{0, 1, 0};
  MaterialRef material{};
};

template <>
inline constexpr auto fields<Plane> = field_list("plane",
                                                 field("point", &Plane::point, rule::point),
                                                 field("normal", &Plane::normal, rule::direction),
                                                 field("material", &Plane::material,
                                                       rule::material));

/// All points within `radius` of the segment from `a` to `b`, both part of it; a sphere if they are
/// equal.
struct Capsule {
  Vec3f a{};
  Vec3f b{};
  float radius = 1;
  MaterialRef material{};
};

template <>
inline constexpr auto fields<Capsule> = field_list(
    "capsule", field("a", &Capsule::a, rule::point), field("b", &Capsule::b, rule::point),
    field("radius", &Capsule::radius, rule::positive),
    field("material", &Capsule::material, rule::material));

/// True if a sphere by itself has no Problem. Short and inline, because there may be millions.
inline bool is_valid(const Sphere& sphere) {
  const auto& [x, y, z] = sphere.center;
  const float radius = sphere.radius;
  // x - x is 0, or NaN where x is not finite: one comparison for four numbers.
  const float zero = (x - x) + (y - y) + (z - z) + (radius - radius);
  return zero == 0 && radius > 0;
}

/// The first Problem of a primitive by itself: a field against its rule. validate() checks
/// whether the scene has the material.
std::optional<Problem> find_problem(const Sphere& sphere);
std::optional<Problem> find_problem(const Plane& plane);
std::optional<Problem> find_problem(const Capsule& capsule);

}  // namespace boule
