#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace boule {

/// True for a finite number that is not too large for a float. NaN and Inf are not.
inline bool fits_float32(double value) {
  // Halfway between FLT_MAX and 2^128: from here on, rounding to nearest would give Inf.
  constexpr double too_large = 0x1.ffffffp127;
  return std::fabs(value) < too_large;
}

/// Rounds a number from a file to the nearest float. Nothing where a finite number is too large for
/// one; an underflow becomes denormal or 0; NaN and Inf stay what they are.
inline std::optional<float> to_float32(double value) {
  if (std::isfinite(value) && !fits_float32(value)) return std::nullopt;
  return static_cast<float>(value);
}

/// As to_float32(), but NaN where the number is too large.
inline float float32_or_nan(double value) {
  return fits_float32(value) ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
}
inline float float32_or_nan(float value) { return value; }

/// As to_float32(), but infinite where the number is too large.
inline float float32_or_inf(double value) {
  if (fits_float32(value) || std::isnan(value)) return static_cast<float>(value);
  return std::copysign(std::numeric_limits<float>::infinity(), value > 0 ? 1.0F : -1.0F);
}
inline float float32_or_inf(float value) { return value; }

}  // namespace boule
