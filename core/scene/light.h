#pragma once

#include <optional>
#include <variant>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// The falloff of a point light with distance d: none (the lecture's), or 1 / d^2.
enum class Falloff { none, inverse_square };
template <>
inline constexpr std::array<std::string_view, 2> names<Falloff>{"none", "inverse_square"};

/// The frame of a light's numbers. scene: the scene's axes. camera: the camera's axes, which are
/// its right, its up and its backward direction. Positions then count from the eye, and lengths are
/// in units of the distance from the eye to look_at, so that the light follows a fitted camera.
enum class LightFrame { scene, camera };
template <>
inline constexpr std::array<std::string_view, 2> names<LightFrame>{"scene", "camera"};

/// Light from one point in all directions.
struct PointLight {
  Vec3f position{};
  Color intensity{1, 1, 1};
  Falloff falloff = Falloff::none;
  LightFrame relative_to = LightFrame::scene;
};

template <>
inline constexpr auto fields<PointLight> = field_list(
    "point", field("position", &PointLight::position, rule::point),
    field("intensity", &PointLight::intensity, rule::not_negative),
    field("falloff", &PointLight::falloff), field("relative_to", &PointLight::relative_to));

/// Light from infinitely far away; `direction` is the way it travels (any length but 0).
struct DirectionalLight {
  Vec3f direction{0, -1, 0};
  Color intensity{1, 1, 1};
  LightFrame relative_to = LightFrame::scene;
};

template <>
inline constexpr auto fields<DirectionalLight> =
    field_list("directional", field("direction", &DirectionalLight::direction, rule::direction),
               field("intensity", &DirectionalLight::intensity, rule::not_negative),
               field("relative_to", &DirectionalLight::relative_to));

/// A sphere that radiates equally in all directions. It is not an object: rays pass through it.
struct SphereLight {
  Vec3f center{};
  float radius = 1;
  Color radiance{1, 1, 1};
  LightFrame relative_to = LightFrame::scene;
};

template <>
inline constexpr auto fields<SphereLight> =
    field_list("sphere", field("center", &SphereLight::center, rule::point),
               field("radius", &SphereLight::radius, rule::positive),
               field("radiance", &SphereLight::radiance, rule::not_negative),
               field("relative_to", &SphereLight::relative_to));

using Light = std::variant<PointLight, DirectionalLight, SphereLight>;

/// The first Problem of a light: a field against its rule.
std::optional<Problem> find_problem(const Light& light);

}  // namespace boule
