#pragma once

#include <optional>
#include <variant>

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

using Background = std::variant<ConstantBackground, GradientBackground>;

/// The first Problem of a background: anything not finite or negative, a zero up.
std::optional<Problem> find_problem(const Background& background);

}  // namespace boule
