#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// One colour for every ray that misses (the lecture's).
struct ConstantBackground {
  Color color{};
};

template <>
inline constexpr auto fields<ConstantBackground> =
    field_list("constant", field("color", &ConstantBackground::color, rule::not_negative));

/// bottom + (top - bottom) (1 + d.up) / 2 for a ray of unit direction d.
struct GradientBackground {
  Color bottom{1, 1, 1};
  Color top{0.5f, 0.7f, 1.0f};
  Vec3f up{0, 1, 0};
};

template <>
inline constexpr auto fields<GradientBackground> =
    field_list("gradient", field("bottom", &GradientBackground::bottom, rule::not_negative),
               field("top", &GradientBackground::top, rule::not_negative),
               field("up", &GradientBackground::up, rule::direction));

/// A latitude-longitude image of the surroundings of the scene. Its top row is up (+y); its middle
/// is in direction -z, or `rotation` degrees to the right of that.
struct EnvironmentBackground {
  int width = 0, height = 0;    ///< >= 1
  std::vector<Color> pixels{};  ///< radiance, row by row, the top one first
  float rotation = 0;
};

template <>
inline constexpr auto fields<EnvironmentBackground> = field_list(
    "environment",
    field("size", &EnvironmentBackground::width, &EnvironmentBackground::height, rule::from_file),
    field("file", &EnvironmentBackground::pixels, rule::from_file),
    field("rotation", &EnvironmentBackground::rotation, rule::finite));

using Background = std::variant<ConstantBackground, GradientBackground, EnvironmentBackground>;

/// The first Problem of a background: a field against its rule, or an image without width x height
/// pixels of finite numbers of 0 or above.
std::optional<Problem> find_problem(const Background& background);

}  // namespace boule
