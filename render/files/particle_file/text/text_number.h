#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/text.h"

namespace boule {

/// The nearest double to a decimal number in any notation: "1", "-.5", "+1e3", Fortran's "1.5D+02",
/// "nan", "inf"; too large a number gives infinity. Nothing for any other text.
std::optional<double> number_in(std::string_view token);

/// A whole number from 0 on; nothing for any other text, and for numbers above 2^64 - 1.
std::optional<std::uint64_t> count_in(std::string_view token);

/// True for what tables have in place of a number that is not there: nothing, "nan", "null", "NA",
/// "n/a", "none", "--", "-" and the like, in any case.
bool is_missing_text(std::string_view token);

/// A number with a decimal comma as one with a point; other texts as they are.
std::string with_decimal_point(std::string_view token);

/// 1 for "T", "true", "True", "TRUE", and 0 for the same of false; nothing for any other text.
std::optional<double> logical_in(std::string_view token);

/// Reads a number whose digits and power of ten are exact in double, so that one division or
/// multiplication rounds it correctly (W. D. Clinger, How to read floating point numbers
/// accurately, 1990). Returns where it ends, or null for all other text.
inline const char* read_short_number(const char* at, const char* end, double& value) {
  constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr int largest_power = 22, most_digits = 19;  // so many fit into 64 bits
  constexpr std::uint64_t largest = std::uint64_t{1} << 53;
  const bool negative = at < end && *at == '-';
  if (negative) ++at;
  std::uint64_t digits = 0;
  const char* const begin = at;
  for (; at < end && is_digit(*at); ++at) digits = 10 * digits + static_cast<unsigned>(*at - '0');
  std::ptrdiff_t count = at - begin, power = 0;
  if (at < end && *at == '.') {
    const char* const point = ++at;
    for (; at < end && is_digit(*at); ++at) digits = 10 * digits + static_cast<unsigned>(*at - '0');
    power = point - at;
    count -= power;
  }
  if (count == 0 || count > most_digits || digits > largest) return nullptr;
  if (at < end && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool down = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) ++at;
    int exponent = 0;
    const char* const first = at;
    for (; at < end && is_digit(*at) && at - first < 4; ++at)
      exponent = 10 * exponent + (*at - '0');
    if (at == first) return nullptr;
    power += down ? -exponent : exponent;
  }
  if (power < -largest_power || power > largest_power) return nullptr;
  const auto whole = static_cast<double>(digits);
  const double size = power < 0 ? whole / powers[-power] : whole * powers[power];
  value = negative ? -size : size;
  return at;
}

}  // namespace boule
