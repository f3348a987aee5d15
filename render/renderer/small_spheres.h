#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "render/frame/pixel_rect.h"

namespace boule {

struct PreparedScene;

/// The pixels of a picture in which spheres and capsules may hide from the rays through the pixels'
/// centres: those that a sphere touches, or a part of a capsule, which is at most 1.5 pixels wide.
/// A wider one covers the centre of a pixel wherever it lies.
class SmallSpheres {
 public:
  SmallSpheres() = default;
  /// Of the frame's pixels in `rect`, in a frame `width` pixels wide. Preconditions: the camera has
  /// no lens. Throws std::bad_alloc, and the exceptions of `parallel_for`.
  SmallSpheres(const PreparedScene& scene, int width, const PixelRect& rect,
               const ParallelFor& parallel_for);

  /// Precondition: the pixel lies in `rect`.
  [[nodiscard]] bool may_hide(int x, int y) const {
    return everywhere_ || (!marks_.empty() && marks_[rect_.index(x, y)] != 0);
  }

 private:
  class Marker;

  PixelRect rect_;
  bool everywhere_ = false;          ///< the camera's map of distortions is not inverted
  std::vector<std::uint8_t> marks_;  ///< by pixel; empty: none
};

}  // namespace boule
