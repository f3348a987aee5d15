#include "render/image/pixel_layer.h"

#include <cstddef>

namespace boule {
namespace {

/// A colour over another, each with its alpha, rounded to the nearest code.
void put_over(const std::uint8_t* over, int channels, std::uint8_t* under) {
  const unsigned a = over[3], b = channels == 4 ? under[3] : 255U;
  if (a == 0) return;
  const unsigned rest = b * (255 - a), all = 255 * a + rest;  // 255 times the alpha of both
  for (int i = 0; i < 3; ++i)
    under[i] = static_cast<std::uint8_t>((255 * a * over[i] + rest * under[i] + all / 2) / all);
  if (channels == 4) under[3] = static_cast<std::uint8_t>((all + 127) / 255);
}

}  // namespace

void draw_over(const PixelLayer& layer, int first, int channels, std::vector<std::uint8_t>& codes) {
  const auto stride = static_cast<std::size_t>(channels);
  const std::uint8_t* over = layer.codes.data() + 4 * static_cast<std::size_t>(first) *
                                                      static_cast<std::size_t>(layer.width);
  for (std::size_t i = 0; i + stride <= codes.size(); i += stride, over += 4)
    put_over(over, channels, &codes[i]);
}

}  // namespace boule
