#pragma once

#include <optional>
#include <variant>

#include "core/math/color.h"
#include "core/scene/primitive.h"

namespace boule {

/// How a point light weakens with distance d: not at all (the lecture's), or as 1 / d^2.
enum class Falloff { none, inverse_square };

/// Light from one point in all directions.
struct PointLight {
  Vec3f position;
  Color intensity{1, 1, 1};
  Falloff falloff = Falloff::none;
};

/// Light from infinitely far away; `direction` is the way it travels (any length but 0).
struct DirectionalLight {
  Vec3f direction{0, -1, 0};
  Color intensity{1, 1, 1};
};

/// Light from a sphere, the same in all directions. It is no object: rays pass through it.
struct SphereLight {
  Vec3f center;
  float radius = 1;
  Color radiance{1, 1, 1};
};

using Light = std::variant<PointLight, DirectionalLight, SphereLight>;

/// The first Problem of a light: anything not finite, negative intensity or
/// radiance, a zero direction, radius <= 0.
std::optional<Problem> find_problem(const Light& light);

}  // namespace boule
