#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/color.h"
#include "core/math/srgb.h"
#include "core/scene/names.h"

namespace boule {

/// The colour maps with names.
enum class NamedColorMap { viridis, magma, plasma, inferno, cividis, coolwarm, turbo, grey };
template <>
inline constexpr std::array<std::string_view, 8> names<NamedColorMap>{
    "viridis", "magma", "plasma", "inferno", "cividis", "coolwarm", "turbo", "grey"};

/// A map from numbers in [0, 1] to colours: evenly spaced colours, at least one, and straight lines
/// between them in sRGB codes.
class ColorMap {
 public:
  explicit ColorMap(NamedColorMap name = NamedColorMap::viridis);
  /// Precondition: colors is not empty.
  explicit ColorMap(std::vector<SrgbColor> colors);

  /// The same colours the other way round.
  [[nodiscard]] ColorMap reversed() const;

  /// Whether its middle stands for 0: of numbers on both sides of it.
  [[nodiscard]] bool is_diverging() const { return is_diverging_; }

  /// The colour of `at`; below 0 that of 0, above 1 that of 1. Precondition: at is not NaN.
  [[nodiscard]] SrgbColor color(double at) const;

 private:
  std::vector<SrgbColor> colors_;
  bool is_diverging_ = false;
};

/// The map of a name in any case; "_r" behind the name reverses it. None for other text.
std::optional<ColorMap> named_color_map(std::string_view text);

/// "; did you mean 'viridis_r'?" for what is near to such a name, else "".
std::string did_you_mean_map(std::string_view text);

/// The colour of particles without a number.
inline constexpr SrgbColor missing_color{0xa0, 0xa0, 0xa0};

/// The position of a number between the ends of a range, for a colour map: 0 at the least, 1 at the
/// largest, 0.5 if the ends are equal. All are finite; their difference may be too large for a
/// double.
class RangePlace {
 public:
  explicit RangePlace(const std::array<double, 2>& range)
      : least_(range[0]), width_(range[1] - range[0]), half_(range[1] / 2 - range[0] / 2) {}

  [[nodiscard]] double operator()(double number) const {
    if (!(half_ > 0)) return 0.5;
    return std::isfinite(width_) ? (number - least_) / width_ : (number / 2 - least_ / 2) / half_;
  }

 private:
  double least_, width_, half_;
};

}  // namespace boule
