#include "core/math/srgb.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/base/float_environment.h"
#include "core/math/elementary.h"

namespace boule {
namespace {

/// The least float whose code is at least this one.
float first_of(int code) {
  const double v = linear_from_srgb((code - 0.5) / 255);
  const auto nearest = static_cast<float>(v);
  if (static_cast<double>(nearest) >= v) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

}  // namespace

std::optional<SrgbColor> parse_hex_color(std::string_view text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  std::array<std::uint8_t, 3> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const char* const first = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, codes[i], 16);
    if (error != std::errc() || end != first + 2) return std::nullopt;
  }
  return SrgbColor{codes[0], codes[1], codes[2]};
}

std::string hex_text(SrgbColor color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t code : {color.r, color.g, color.b}) {
    text += digits[code / 16U];
    text += digits[code % 16U];
  }
  return text;
}

double linear_from_srgb(double s) {
  return s <= 0.04045 ? s / 12.92 : elementary::pow((s + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double v) {
  return v <= 0.0031308 ? v * 12.92 : 1.055 * elementary::pow(v, 1 / 2.4) - 0.055;
}

double srgb_displayed(double v) { return srgb_from_linear(std::clamp(v, 0.0, 1.0)); }

SrgbTable::SrgbTable() {
  const FloatEnvironment environment;  // the table serves later calls, too
  step_[0] = 0;
  step_[256] = std::numeric_limits<float>::infinity();
  for (int code = 1; code < 256; ++code) step_[static_cast<std::size_t>(code)] = first_of(code);
  for (int code = 0; code < 256; ++code) {
    linear_[static_cast<std::size_t>(code)] = static_cast<float>(linear_from_srgb(code / 255.0));
  }
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    const float low = std::bit_cast<float>(static_cast<std::uint32_t>(bucket) << 16);
    const auto above = std::upper_bound(step_.begin(), step_.end(), low);
    base_[bucket] = static_cast<std::uint8_t>(above - step_.begin() - 1);
  }
}

const SrgbTable& SrgbTable::get() {
  static const SrgbTable table;
  return table;
}

Color linear_of(SrgbColor color) {
  const SrgbTable& table = SrgbTable::get();
  return {table.linear(color.r), table.linear(color.g), table.linear(color.b)};
}

SrgbColor srgb_of(const Color& color) {
  const SrgbTable& table = SrgbTable::get();
  return {table.code(color.r), table.code(color.g), table.code(color.b)};
}

}  // namespace boule
