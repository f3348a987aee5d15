#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "render/renderer/renderer.h"
#include "tests/support/bit_hash.h"

namespace boule::test {

inline MeasuredPicture measured(const Scene& scene, const RenderOptions& options) {
  Renderer renderer = Renderer::create(scene, options).value();
  MeasuredPicture picture(renderer.rect());
  EXPECT_TRUE(renderer.render_measured(picture));
  return picture;
}

/// Of the pixels in `rect`.
inline std::uint64_t hash_of(const MeasuredPicture& picture, const PixelRect& rect) {
  BitHash hash;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (const MeasuredPixel& pixel : picture.row(rect.x0, rect.x1, y)) {
      for (const float x : {pixel.color.r, pixel.color.g, pixel.color.b, pixel.alpha, pixel.noise})
        hash.add(x);
      hash.add(static_cast<float>(pixel.samples));
    }
  }
  return hash.value();
}

inline std::uint64_t hash_of(const MeasuredPicture& picture) {
  return hash_of(picture, picture.rect());
}

}  // namespace boule::test
