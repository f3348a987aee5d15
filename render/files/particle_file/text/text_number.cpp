#include "render/files/particle_file/text/text_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#if __has_include(<fast_float/fast_float.h>)
// Twice as fast as the standard library's, to the same bits. gemmi brings an older one of its own,
// whose functions would have the same names.
#define fast_float boule_fast_float
#include <fast_float/fast_float.h>
#undef fast_float
#endif

#include "core/base/text.h"

namespace boule {
namespace {

template <class Number>
std::from_chars_result parse(std::string_view token, Number& value) {
  return std::from_chars(token.data(), token.data() + token.size(), value);
}

/// Numbers beyond the range of double become 0 or infinity. A long double has more range; what is
/// beyond even that is told by the sign of its power.
std::optional<double> out_of_range(std::string_view token) {
  long double wide = 0;
  const auto read = parse(token, wide);
  if (read.ec == std::errc()) return static_cast<double>(wide);
  const bool small =
      token.find("e-") != std::string_view::npos || token.find("E-") != std::string_view::npos;
  const double size = small ? 0 : HUGE_VAL;
  return token.front() == '-' ? -size : size;
}

}  // namespace

const char* number_at(const char* at, const char* end, double& value) {
#if __has_include(<fast_float/fast_float.h>)
  const auto read = boule_fast_float::from_chars(at, end, value);
#else
  const auto read = std::from_chars(at, end, value);
#endif
  return read.ec == std::errc() && std::isfinite(value) ? read.ptr : nullptr;
}

std::optional<double> number_in(std::string_view token) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  if (token.empty()) return std::nullopt;
  double value = 0;
  auto read = parse(token, value);
  const char* const end = token.data() + token.size();
  if (read.ec == std::errc() && read.ptr == end) return value;
  std::string changed;
  if (read.ptr != end && (*read.ptr == 'D' || *read.ptr == 'd') && is_digit(token.back())) {
    changed = token;
    changed[static_cast<std::size_t>(read.ptr - token.data())] = 'e';
    token = changed;
    read = parse(token, value);
    if (read.ec == std::errc() && read.ptr == token.data() + token.size()) return value;
  }
  if (read.ec != std::errc::result_out_of_range) return std::nullopt;
  if (read.ptr != token.data() + token.size()) return std::nullopt;
  return out_of_range(token);
}

std::optional<std::uint64_t> count_in(std::string_view token) {
  std::uint64_t value = 0;
  const auto read = parse(token, value);
  if (read.ec != std::errc() || read.ptr != token.data() + token.size()) return std::nullopt;
  return value;
}

bool is_missing_text(std::string_view token) {
  constexpr std::size_t longest = 5;
  constexpr std::array<std::string_view, 13> texts{
      "", "nan", "-nan", "<na>", "null", "na", "n/a", "#n/a", "#na", "none", "--", "-", "\\n"};
  if (token.size() > longest) return false;
  return std::find(texts.begin(), texts.end(), ascii_lower(token)) != texts.end();
}

std::string with_decimal_point(std::string_view token) {
  std::string text(token);
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos && text.find('.') == std::string::npos) text[comma] = '.';
  return text;
}

std::optional<double> logical_in(std::string_view token) {
  if (token == "T" || token == "True" || token == "true" || token == "TRUE") return 1;
  if (token == "F" || token == "False" || token == "false" || token == "FALSE") return 0;
  return std::nullopt;
}

}  // namespace boule
