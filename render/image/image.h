#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/math/color.h"

namespace boule {

/// The alpha of a picture: the coverage of each pixel, or none.
enum class Alpha { none, coverage };

/// A picture in memory: linear RGB float, row 0 on top, pixels[y * width + x]. If it has alpha,
/// colours are premultiplied: the colour of the covered part times its fraction of the pixel.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels{};
  std::vector<float> alpha{};  ///< by pixel, 0..1; empty: no alpha

  Image() = default;
  /// A black picture; with alpha it is fully transparent. Sides below 0 count as 0.
  Image(int w, int h, Alpha with = Alpha::none)
      : width(std::max(w, 0)),
        height(std::max(h, 0)),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        alpha(with == Alpha::none ? 0 : pixels.size()) {}
  /// Pixel (x, y). Precondition: there is one.
  Color& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Color& at(int x, int y) const { return pixels[index(x, y)]; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  /// Sets the pixel with this index, and its alpha if the picture has alpha. Precondition: the
  /// index is valid.
  void set(std::size_t pixel, const Color& color, float covered) {
    pixels[pixel] = color;
    if (!alpha.empty()) alpha[pixel] = covered;
  }
  /// Copies pixel (from_x, from_y) to pixel (x, y). Precondition: both exist.
  void copy_pixel(int from_x, int from_y, int x, int y) {
    const std::size_t from = index(from_x, from_y);
    set(index(x, y), pixels[from], alpha.empty() ? 1 : alpha[from]);
  }
};

}  // namespace boule
