#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/math/color.h"
#include "core/math/coverage.h"
#include "render/frame/pixel_rect.h"
#include "render/image/image.h"

namespace boule {

/// The samples of a pixel so far: their sum and their number.
struct FilmPixel {
  double r = 0, g = 0, b = 0;
  std::int32_t samples = 0;
  std::uint32_t covered = 0;  ///< sum of the samples' coverage
};

/// The samples so far of a picture, or of a part of it: their sum and their number per pixel. Two
/// threads may add to different pixels in parallel.
class Film {
 public:
  /// A film of the frame's pixels in `rect`. Precondition of all functions that take a pixel: it
  /// lies in `rect`.
  explicit Film(const PixelRect& rect) { restart(rect); }
  /// A film that was moved from has no pixels.
  Film(Film&& other) noexcept
      : rect_(std::exchange(other.rect_, {})), pixels_(std::move(other.pixels_)) {}
  Film(const Film&) = default;
  Film& operator=(Film other) noexcept {
    std::swap(rect_, other.rect_);
    std::swap(pixels_, other.pixels_);
    return *this;
  }

  /// Starts again with other pixels, in the same memory if it is large enough. The film is
  /// unchanged if this throws.
  void restart(const PixelRect& rect) {
    pixels_.assign(static_cast<std::size_t>(rect.area()), {});
    rect_ = rect.empty() ? PixelRect{} : rect;
  }

  [[nodiscard]] const PixelRect& rect() const { return rect_; }

  /// Adds a sample to pixel (x, y) of the frame. Preconditions: the sample is finite, and the pixel
  /// has fewer than 2147483647.
  void add(int x, int y, const Color& sample) {
    FilmPixel& pixel = pixels_[rect_.index(x, y)];
    pixel.r += static_cast<double>(sample.r);
    pixel.g += static_cast<double>(sample.g);
    pixel.b += static_cast<double>(sample.b);
    ++pixel.samples;
  }
  /// The same for a sample with its coverage by objects, 0 .. whole_coverage. Precondition: the
  /// pixel has fewer than most_covered_samples samples.
  void add(int x, int y, const Color& sample, std::uint8_t covered) {
    add(x, y, sample);
    pixels_[rect_.index(x, y)].covered += covered;
  }

  /// The number of samples of pixel (x, y) of the frame.
  [[nodiscard]] int samples(int x, int y) const { return pixels_[rect_.index(x, y)].samples; }

  /// The number of samples of all pixels together.
  [[nodiscard]] std::uint64_t total_samples() const;

  /// The mean of each pixel's samples, at most the largest float; black for pixels without samples.
  /// Alpha is the mean coverage of the samples; 0 for pixels without samples.
  [[nodiscard]] Image to_image(Alpha alpha = Alpha::none) const;

  /// Writes the same into `image`, a picture of the frame's pixels in `rect`, with alpha if the
  /// image has it. Precondition: `rect` holds this film's pixels.
  void copy_to(Image& image, const PixelRect& rect) const;

  /// Pixels [x0, x1) of row y of the frame. Precondition: they lie in rect().
  [[nodiscard]] std::span<const FilmPixel> row(int x0, int x1, int y) const {
    return {pixels_.data() + rect_.index(x0, y), static_cast<std::size_t>(x1 - x0)};
  }
  /// The same, writable: for pixels that are copied from another film.
  [[nodiscard]] std::span<FilmPixel> row(int x0, int x1, int y) {
    return {pixels_.data() + rect_.index(x0, y), static_cast<std::size_t>(x1 - x0)};
  }

  /// The number of bytes of a film of the pixels in `rect`.
  static std::uint64_t bytes(const PixelRect& rect) { return rect.area() * sizeof(FilmPixel); }

 private:
  PixelRect rect_;
  std::vector<FilmPixel> pixels_;
};

}  // namespace boule
