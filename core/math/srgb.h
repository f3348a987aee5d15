#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/math/color.h"

namespace boule {

/// A colour of 8 bits a component, with the sRGB curve (IEC 61966-2-1), as "#rrggbb" gives it.
struct SrgbColor {
  std::uint8_t r = 0, g = 0, b = 0;
};
constexpr bool operator==(const SrgbColor& a, const SrgbColor& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// "#rrggbb" as a colour, or std::nullopt for other text; and a colour as "#rrggbb".
std::optional<SrgbColor> parse_hex_color(std::string_view text);
std::string hex_text(SrgbColor color);

/// The linear value of a value `s` of the sRGB curve, exact for 0..1. The curve continues outside
/// of 0..1. Same bits on every machine.
double linear_from_srgb(double s);
/// The inverse, for 0..1.
double srgb_from_linear(double v);

/// The displayed value of any number: srgb_from_linear() after clamping to 0..1.
double srgb_displayed(double v);

/// From linear values to codes and back by tables, without a power for each value. The upper 16
/// bits of a float below 1 choose a bucket, whose relative width is 2^-7. Any two steps from code
/// to code are farther apart than that, so a bucket holds at most one step, and one comparison
/// decides.
class SrgbTable {
 public:
  /// The one table of the program, made on first use.
  static const SrgbTable& get();

  /// The nearest code of the exact curve; NaN and numbers below 0 have code 0, those above 1 have
  /// code 255.
  [[nodiscard]] std::uint8_t code(float v) const {
    if (!(v > 0)) return 0;
    if (v >= 1) return 255;
    const std::size_t base = base_[std::bit_cast<std::uint32_t>(v) >> 16];
    return static_cast<std::uint8_t>(base + (v >= step_[base + 1] ? 1U : 0U));
  }

  /// The linear value of a code.
  [[nodiscard]] float linear(std::uint8_t code) const { return linear_[code]; }

 private:
  SrgbTable();

  static constexpr std::size_t buckets = 0x3f80;  // the upper half of 1.0f

  std::array<float, 257> step_{};  ///< step_[c]: the least float of code c
  std::array<float, 256> linear_{};
  std::array<std::uint8_t, buckets> base_{};
};

/// The linear colour of an SrgbColor, and the nearest SrgbColor of a linear colour (SrgbTable).
Color linear_of(SrgbColor color);
SrgbColor srgb_of(const Color& color);

}  // namespace boule
