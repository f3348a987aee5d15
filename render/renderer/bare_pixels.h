#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/color.h"
#include "render/frame/pixel_rect.h"

namespace boule {

struct PreparedScene;

/// The pixels of a picture through which no ray of the camera meets a sphere or a capsule, as far
/// as that is certain without a ray. It takes the rectangles around all of them in the picture, so
/// a pixel may be bare and not be known as such.
class BarePixels {
 public:
  /// None is known.
  BarePixels() = default;
  /// Of the frame's pixels in `rect`. None is known unless the camera is a pinhole or an
  /// orthographic one without distortion, the scene has no planes, and all rays that miss see one
  /// colour. Throws std::bad_alloc, and the exceptions of
  /// `parallel_for`.
  BarePixels(const PreparedScene& scene, const PixelRect& rect, const ParallelFor& parallel_for);

  /// Whether all samples of a pixel of the frame are certain to miss.
  [[nodiscard]] bool is_bare(int x, int y) const {
    if (counts_.empty() || x < rect_.x0 || x >= rect_.x1 || y < rect_.y0 || y >= rect_.y1)
      return false;
    return counts_[index((x - rect_.x0) >> halvings_, (y - rect_.y0) >> halvings_)] == 0;
  }

  /// What is seen through them.
  [[nodiscard]] const Color& color() const { return color_; }

 private:
  class Counter;

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * (static_cast<std::size_t>(columns_) + 1) +
           static_cast<std::size_t>(column);
  }
  void sum_up();

  Color color_;
  PixelRect rect_;
  int halvings_ = 0;  ///< a cell has 2^halvings_ pixels a side
  int columns_ = 0, rows_ = 0;
  /// By cell, with one more at the end of each row and column: the number of rectangles that cover
  /// it; empty: none is known.
  std::vector<std::int32_t> counts_;
};

}  // namespace boule
