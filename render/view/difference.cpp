#include "render/view/difference.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "core/math/srgb.h"
#include "render/image/tone.h"

namespace boule::view {
namespace {

/// A whole number from 1 on, in steps that each are `factor` times the one before: 1 becomes a
/// quarter, factor^3 becomes 1.
double logarithmic(double value, double factor) {
  if (!(value >= 1)) return 0;
  return std::min(0.25 + 0.25 * std::log(value) / std::log(factor), 1.0);
}

/// How many floats lie between two that are not negative; more than a float's range counts as all.
double floats_between(float a, float b) {
  const auto order = [](float x) { return static_cast<double>(std::bit_cast<std::uint32_t>(x)); };
  return std::fabs(order(a) - order(b));
}

std::vector<std::uint8_t> codes_of(Image image, float exposure_stops) {
  image.alpha.clear();
  return tone_map(image, exposure_stops);
}

}  // namespace

Color false_color(double share) {
  // Black, blue, green, yellow, red: evenly spaced.
  constexpr std::array<SrgbColor, 5> colors{
      {{0, 0, 0}, {38, 84, 214}, {32, 160, 80}, {240, 214, 48}, {224, 36, 28}}};
  const double at = std::clamp(share, 0.0, 1.0) * (colors.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), colors.size() - 2);
  const auto rest = static_cast<float>(at - static_cast<double>(low));
  const Color a = linear_of(colors[low]), b = linear_of(colors[low + 1]);
  return a * (1 - rest) + b * rest;
}

Image color_difference(const Image& a, const Image& b, float exposure_stops) {
  constexpr double factor = 4;
  Image difference(a.width, a.height);
  if (a.width != b.width || a.height != b.height) return difference;
  const auto left = codes_of(a, exposure_stops), right = codes_of(b, exposure_stops);
  for (std::size_t i = 0; i < difference.pixels.size(); ++i) {
    int largest = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      largest = std::max(largest, std::abs(int{left[c]} - int{right[c]}));
    if (largest > 0) difference.pixels[i] = false_color(logarithmic(largest, factor));
  }
  return difference;
}

Image t_difference(const std::vector<PixelHit>& a, const std::vector<PixelHit>& b, int width,
                   int height) {
  constexpr double factor = 16;
  constexpr Color magenta{1, 0, 0.7F};
  Image difference(width, height);
  if (a.size() != b.size() || a.size() != difference.pixels.size()) return difference;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].id != b[i].id) {
      difference.pixels[i] = magenta;
    } else if (a[i].depth != b[i].depth) {
      difference.pixels[i] =
          false_color(logarithmic(floats_between(a[i].depth, b[i].depth), factor));
    }
  }
  return difference;
}

}  // namespace boule::view
