#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/math/color.h"

namespace boule {

/// A picture in memory: linear RGB float, row 0 on top, pixels[y * width + x].
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;

  Image() = default;
  /// A black picture. Sides below 0 count as 0.
  Image(int w, int h)
      : width(std::max(w, 0)),
        height(std::max(h, 0)),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  /// Pixel (x, y). Precondition: there is one.
  Color& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Color& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace boule
