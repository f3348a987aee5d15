#include "render/files/scene_file/nff/nff_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "render/files/file/float32.h"

namespace boule {
namespace {

constexpr const char* too_large = "is too large for a 32-bit float";

/// Space, '\t', '\v', '\f' or '\r' (and '\n', which no line has within).
bool is_nff_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::size_t skip_blanks(std::string_view line, std::size_t at) {
  while (at < line.size() && is_nff_blank(line[at])) ++at;
  return at;
}

std::size_t skip_word(std::string_view line, std::size_t at) {
  while (at < line.size() && !is_nff_blank(line[at])) ++at;
  return at;
}

/// from_chars knows no leading '+', printf and people do.
std::string_view without_plus(std::string_view word) {
  const bool is_signed = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return is_signed ? word.substr(1) : word;
}

/// For a decimal number beyond double's range: true if it is too small, not too large.
/// (from_chars says only that it is out of range.)
bool is_tiny(std::string_view number) {
  const std::string_view mantissa = number.substr(0, number.find_first_of("eE"));
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const std::string_view power =
      without_plus(number.substr(std::min(mantissa.size() + 1, number.size())));
  std::int64_t exponent = 0;
  const auto result = std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (result.ec == std::errc::result_out_of_range) return power[0] == '-';
  return exponent < first - point;
}

}  // namespace

bool NffCursor::next_line() {
  while (!rest_.empty()) {
    const void* found = std::memchr(rest_.data(), '\n', rest_.size());
    const std::size_t end =
        found == nullptr ? rest_.size()
                         : static_cast<std::size_t>(static_cast<const char*>(found) - rest_.data());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    at_ = 0;
    if (!at_line_end()) return true;
  }
  return false;
}

bool NffCursor::at_line_end() {
  const std::size_t next = skip_blanks(line_, at_);
  if (next < line_.size() && line_[next] == '#') line_ = line_.substr(0, next);
  return next == line_.size();
}

std::string_view NffCursor::take_word() {
  if (at_line_end()) return {};
  const std::size_t start = skip_blanks(line_, at_);
  at_ = skip_word(line_, start);
  return line_.substr(start, at_ - start);
}

bool NffCursor::take_number_word(const char* key, const char* expected, std::string_view& word) {
  const std::string_view next = take_word();
  word = without_plus(next);
  if (!next.empty()) return true;
  error_->report(end_place(), key, std::string("expected ") + expected + ", the line ends here");
  return false;
}

bool NffCursor::take(const char* key, double& out) {
  const std::size_t start = skip_blanks(line_, at_);
  const char* const line_end = line_.data() + line_.size();
  double number = 0;
  const auto [end, code] = std::from_chars(line_.data() + start, line_end, number);
  const bool is_word = end == line_end || is_nff_blank(*end);
  if (code != std::errc{} || !is_word || !std::isfinite(number)) return take_unusual(key, out);
  at_ = static_cast<std::size_t>(end - line_.data());
  out = number;
  return true;
}

bool NffCursor::take_unusual(const char* key, double& out) {
  std::string_view word;
  if (!take_number_word(key, "a number", word)) return false;
  double number = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = code != std::errc::invalid_argument && end == word.data() + word.size();
  if (!is_number) return report(word, key, "expected a number, got " + quote(word));
  if (!std::isfinite(number)) return report(word, key, "must be finite");
  if (code == std::errc::result_out_of_range) {
    if (!is_tiny(word)) return report(word, key, too_large);
    number = word[0] == '-' ? -0.0 : 0.0;
  }
  out = number;
  return true;
}

bool NffCursor::take_from(const char* key, double zero, float& out) {
  const std::size_t before = at_;
  double number = 0;
  if (!take(key, number)) return false;
  const auto rounded = to_float32(number - zero);
  if (!rounded) {
    const std::size_t start = skip_blanks(line_, before);
    return report(without_plus(line_.substr(start, at_ - start)), key, too_large);
  }
  out = *rounded;
  return true;
}

bool NffCursor::take(const char* key, float& out) { return take_from(key, 0, out); }

bool NffCursor::take_point(const char* key, Vec3f& out) {
  return take_from(key, origin_.x, out.x) && take_from(key, origin_.y, out.y) &&
         take_from(key, origin_.z, out.z);
}

bool NffCursor::take(const char* key, Vec3f& out) {
  return take(key, out.x) && take(key, out.y) && take(key, out.z);
}

bool NffCursor::take(const char* key, Color& out) {
  return take(key, out.r) && take(key, out.g) && take(key, out.b);
}

bool NffCursor::take(const char* key, int& out) {
  std::string_view word;
  if (!take_number_word(key, "an integer", word)) return false;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), out);
  if (code == std::errc{} && end == word.data() + word.size()) return true;
  return report(word, key, "expected an integer of 32 bits, got " + quote(word));
}

bool NffCursor::take_line_end(const char* key) {
  if (at_line_end()) return true;
  const std::string_view word = take_word();
  return report(word, key, "expected the end of the line, got " + quote(word));
}

bool NffCursor::report(std::string_view word, const char* key, std::string message) {
  error_->report(place_of(at_ - word.size()), key, std::move(message));
  return false;
}

TextPlace NffCursor::place(std::size_t index) const {
  std::size_t start = skip_blanks(line_, 0);
  for (; index > 0; --index) start = skip_blanks(line_, skip_word(line_, start));
  return place_of(start);
}

TextPlace NffCursor::place_of(std::size_t offset) const {
  return {std::max(static_cast<int>(number_), 1), static_cast<int>(offset) + 1};
}

}  // namespace boule
