#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/math/color.h"
#include "core/scene/primitive.h"

namespace boule {

/// One colour for every ray that misses (the lecture's).
struct ConstantBackground {
  Color color;
};

/// bottom + (top - bottom) (1 + d.up) / 2 for a ray of unit direction d.
struct GradientBackground {
  Color bottom{1, 1, 1};
  Color top{0.5f, 0.7f, 1.0f};
  Vec3f up{0, 1, 0};
};

/// An image of everything around, latitude-longitude: its top row is up (+y), its middle is seen
/// along -z, or `rotation` degrees to the right of that.
struct EnvironmentBackground {
  int width = 0, height = 0;  ///< >= 1
  std::vector<Color> pixels;  ///< radiance, row by row, the top one first
  float rotation = 0;
};

using Background = std::variant<ConstantBackground, GradientBackground, EnvironmentBackground>;

/// The first Problem of a background: anything not finite or negative, a zero up, an image without
/// width x height pixels.
std::optional<Problem> find_problem(const Background& background);

}  // namespace boule
