#pragma once

#include <optional>
#include <variant>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// How a point light weakens with distance d: not at all (the lecture's), or as 1 / d^2.
enum class Falloff { none, inverse_square };
template <>
inline constexpr std::array<std::string_view, 2> names<Falloff>{"none", "inverse_square"};

/// Light from one point in all directions.
struct PointLight {
  Vec3f position;
  Color intensity{1, 1, 1};
  Falloff falloff = Falloff::none;
};

template <>
inline constexpr auto fields<PointLight> =
    field_list("point", field("position", &PointLight::position, rule::finite),
               field("intensity", &PointLight::intensity, rule::not_negative),
               field("falloff", &PointLight::falloff));

/// Light from infinitely far away; `direction` is the way it travels (any length but 0).
struct DirectionalLight {
  Vec3f direction{0, -1, 0};
  Color intensity{1, 1, 1};
};

template <>
inline constexpr auto fields<DirectionalLight> =
    field_list("directional", field("direction", &DirectionalLight::direction, rule::direction),
               field("intensity", &DirectionalLight::intensity, rule::not_negative));

/// A sphere that radiates alike in all directions. It is not an object: rays pass through it.
struct SphereLight {
  Vec3f center;
  float radius = 1;
  Color radiance{1, 1, 1};
};

template <>
inline constexpr auto fields<SphereLight> =
    field_list("sphere", field("center", &SphereLight::center, rule::finite),
               field("radius", &SphereLight::radius, rule::positive),
               field("radiance", &SphereLight::radiance, rule::not_negative));

using Light = std::variant<PointLight, DirectionalLight, SphereLight>;

/// The first Problem of a light: a field against its rule.
std::optional<Problem> find_problem(const Light& light);

}  // namespace boule
