#pragma once

#include <cmath>
#include <optional>

namespace boule {

/// The one rounding of a number from a file: to the nearest float. Nothing where a finite number
/// is too large for one; an underflow becomes denormal or 0; NaN and Inf stay what they are.
inline std::optional<float> to_float32(double value) {
  // Halfway between FLT_MAX and 2^128: from here on, rounding to nearest would give Inf.
  constexpr double too_large = 0x1.ffffffp127;
  if (!std::isfinite(value)) return static_cast<float>(value);
  if (std::fabs(value) >= too_large) return std::nullopt;
  return static_cast<float>(value);
}

}  // namespace boule
