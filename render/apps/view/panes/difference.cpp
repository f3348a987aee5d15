#include "render/apps/view/panes/difference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

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

/// The colour of 0 .. 1.
Color false_color(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (false_colors.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), false_colors.size() - 2);
  const auto rest = static_cast<float>(at - static_cast<double>(low));
  return linear_of(false_colors[low]) * (1 - rest) + linear_of(false_colors[low + 1]) * rest;
}

void mark(DifferencePicture& difference, std::size_t pixel, double value, int factor) {
  ++difference.pixels;
  difference.largest = std::max(difference.largest, value);
  difference.image.pixels[pixel] = false_color(logarithmic(value, factor));
}

std::vector<std::uint8_t> codes_of(Image image, float exposure_stops) {
  image.alpha.clear();
  return tone_map(image, exposure_stops);
}

}  // namespace

DifferencePicture color_difference(const Image& a, const Image& b, float exposure_stops) {
  DifferencePicture difference{Image(a.width, a.height)};
  if (a.width != b.width || a.height != b.height) return difference;
  const auto left = codes_of(a, exposure_stops), right = codes_of(b, exposure_stops);
  for (std::size_t i = 0; i < difference.image.pixels.size(); ++i) {
    int largest = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      largest = std::max(largest, std::abs(int{left[c]} - int{right[c]}));
    if (largest > 0) mark(difference, i, largest, color_factor);
  }
  return difference;
}

DifferencePicture t_difference(const std::vector<PixelHit>& a, const std::vector<PixelHit>& b,
                               int width, int height) {
  DifferencePicture difference{Image(width, height)};
  if (a.size() != b.size() || a.size() != difference.image.pixels.size()) return difference;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].id != b[i].id) {
      ++difference.pixels;
      difference.image.pixels[i] = linear_of(other_primitive);
    } else if (a[i].depth != b[i].depth) {
      mark(difference, i, floats_between(a[i].depth, b[i].depth), ulp_factor);
    }
  }
  return difference;
}

}  // namespace boule::view
