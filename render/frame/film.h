#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/math/color.h"
#include "render/frame/pixel_rect.h"
#include "render/image/image.h"

namespace boule {

/// The samples of a picture so far, or of a part of it: per pixel their sum and number. Two threads
/// may add at the same time to different pixels.
class Film {
 public:
  /// A film of the frame's pixels in `rect`, none where that is empty. Places outside it are
  /// nobody's: precondition of all that take one. Throws std::bad_alloc, or std::length_error where
  /// no memory could be enough.
  explicit Film(const PixelRect& rect) { restart(rect); }
  /// A film that was moved away is empty.
  Film(Film&& other) noexcept
      : rect_(std::exchange(other.rect_, {})), pixels_(std::move(other.pixels_)) {}
  Film(const Film&) = default;
  Film& operator=(Film other) noexcept {
    std::swap(rect_, other.rect_);
    std::swap(pixels_, other.pixels_);
    return *this;
  }

  /// Begins afresh with other pixels, in the same memory where that suffices. Throws likewise, and
  /// the film is as it was.
  void restart(const PixelRect& rect) {
    pixels_.assign(static_cast<std::size_t>(rect.area()), {});
    rect_ = rect.empty() ? PixelRect{} : rect;
  }

  [[nodiscard]] const PixelRect& rect() const { return rect_; }

  /// Adds a finite sample to pixel (x, y) of the frame; 2147483647 of them at most.
  void add(int x, int y, const Color& sample) {
    Pixel& pixel = pixels_[index(x, y)];
    pixel.r += static_cast<double>(sample.r);
    pixel.g += static_cast<double>(sample.g);
    pixel.b += static_cast<double>(sample.b);
    ++pixel.samples;
  }

  /// Samples that pixel (x, y) of the frame has.
  [[nodiscard]] int samples(int x, int y) const { return pixels_[index(x, y)].samples; }

  /// Samples that all pixels have together.
  [[nodiscard]] std::uint64_t total_samples() const;

  /// The mean of each pixel's samples, black where there is none, clamped to the largest float.
  /// Throws std::bad_alloc.
  [[nodiscard]] Image to_image() const;

  /// The same into a picture of the frame's pixels in `rect`, which holds this film's:
  /// precondition.
  void copy_to(Image& image, const PixelRect& rect) const;

  /// Bytes a film of so many pixels takes.
  static std::uint64_t bytes(const PixelRect& rect) { return rect.area() * sizeof(Pixel); }

 private:
  struct Pixel {
    double r = 0, g = 0, b = 0;
    std::int32_t samples = 0;
  };

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
           static_cast<std::size_t>(x - rect_.x0);
  }

  PixelRect rect_;
  std::vector<Pixel> pixels_;
};

}  // namespace boule
