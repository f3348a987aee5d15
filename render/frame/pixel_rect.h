#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// Pixels x0 <= x < x1, y0 <= y < y1 of a frame, row 0 on top. Takes any values; width() and
/// height() are defined where an int holds them.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
  [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
  /// The number of pixels.
  [[nodiscard]] std::uint64_t area() const {
    if (empty()) return 0;
    return static_cast<std::uint64_t>(std::int64_t{x1} - x0) *
           static_cast<std::uint64_t>(std::int64_t{y1} - y0);
  }
  /// The index of pixel (x, y) of the frame, row by row. Precondition: it lies in the rectangle.
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x - x0);
  }
};

inline bool operator==(const PixelRect& a, const PixelRect& b) {
  return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
}

/// True if all of `inner` lies in `outer`.
inline bool contains(const PixelRect& outer, const PixelRect& inner) {
  return inner.x0 >= outer.x0 && inner.y0 >= outer.y0 && inner.x1 <= outer.x1 &&
         inner.y1 <= outer.y1;
}

}  // namespace boule
