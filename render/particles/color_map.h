#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/math/color.h"
#include "core/math/srgb.h"
#include "core/scene/names.h"

namespace boule {

/// The colour maps that are known by name.
enum class NamedColorMap { viridis, magma, plasma, inferno, cividis, coolwarm, turbo, grey };
template <>
inline constexpr std::array<std::string_view, 8> names<NamedColorMap>{
    "viridis", "magma", "plasma", "inferno", "cividis", "coolwarm", "turbo", "grey"};

/// From a number in [0, 1] to a colour: evenly spaced colours, at least one, and straight lines
/// between them in sRGB codes.
class ColorMap {
 public:
  explicit ColorMap(NamedColorMap name = NamedColorMap::viridis);
  /// Precondition: colors is not empty.
  explicit ColorMap(std::vector<SrgbColor> colors);

  /// The colour of `at`; below 0 that of 0, above 1 that of 1. Precondition: at is not NaN.
  [[nodiscard]] SrgbColor color(double at) const;

 private:
  std::vector<SrgbColor> colors_;
};

}  // namespace boule
