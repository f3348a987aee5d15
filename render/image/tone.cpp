#include "render/image/tone.h"

#include <algorithm>
#include <cmath>

#include "core/base/float_environment.h"
#include "core/math/elementary.h"
#include "core/math/srgb.h"

namespace boule {
namespace {

float exposure_scale(float stops) {
  const float bounded = stops != stops ? 0 : std::clamp(stops, -126.0F, 126.0F);
  return static_cast<float>(elementary::pow(2, static_cast<double>(bounded)));
}

/// The code of a share from 0 to 1.
std::uint8_t linear_code(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 255));
}

std::vector<std::uint8_t> tone_map_straight(const Image& image, float scale) {
  const SrgbTable& table = SrgbTable::get();
  std::vector<std::uint8_t> codes(image.pixels.size() * 4);
  std::uint8_t* out = codes.data();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float alpha = image.alpha[i];
    const Color color = alpha > 0 ? image.pixels[i] * (1 / alpha) : Color{};
    for (const float c : {color.r, color.g, color.b}) *out++ = table.code(c * scale);
    *out++ = linear_code(alpha);
  }
  return codes;
}

}  // namespace

std::vector<std::uint8_t> tone_map(const Image& image, float stops) {
  const FloatEnvironment environment;
  const SrgbTable& table = SrgbTable::get();
  const float scale = exposure_scale(stops);
  if (!image.alpha.empty()) return tone_map_straight(image, scale);
  std::vector<std::uint8_t> codes(image.pixels.size() * 3);
  std::uint8_t* out = codes.data();
  const Color* last = nullptr;
  for (const Color& color : image.pixels) {
    if (last != nullptr && color == *last) {  // backgrounds and shadows
      out = std::copy_n(out - 3, 3, out);
    } else {
      for (const float c : {color.r, color.g, color.b}) *out++ = table.code(c * scale);
    }
    last = &color;
  }
  return codes;
}

}  // namespace boule
