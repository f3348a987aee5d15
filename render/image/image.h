#pragma once

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
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Color& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Color& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace boule
