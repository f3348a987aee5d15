#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/color.h"
#include "render/frame/pixel_rect.h"
#include "render/frame/progress.h"
#include "render/image/image.h"

namespace boule {

/// A pixel whose noise was measured.
struct MeasuredPixel {
  Color color{};
  float alpha = 0;  ///< fraction of the pixel that is covered
  /// The standard error of the displayed value (NoiseTarget), of the channel where it is greatest:
  /// the half-width of the 95 % confidence interval divided by 1.96.
  float noise = 0;
  std::uint32_t samples = 0;  ///< number of samples; 0: not rendered yet
};

/// A picture whose noise was measured, or a part of it. Two threads may set different pixels in
/// parallel.
class MeasuredPicture {
 public:
  /// Black, without samples, of the frame's pixels in `rect`. Precondition of all functions that
  /// take a pixel: it lies in `rect`.
  explicit MeasuredPicture(const PixelRect& rect)
      : rect_(rect.empty() ? PixelRect{} : rect), pixels_(static_cast<std::size_t>(rect.area())) {}

  [[nodiscard]] const PixelRect& rect() const { return rect_; }
  [[nodiscard]] MeasuredPixel& at(int x, int y) { return pixels_[rect_.index(x, y)]; }
  [[nodiscard]] const MeasuredPixel& at(int x, int y) const { return pixels_[rect_.index(x, y)]; }
  /// Pixels [x0, x1) of row y of the frame.
  [[nodiscard]] std::span<const MeasuredPixel> row(int x0, int x1, int y) const {
    return {pixels_.data() + rect_.index(x0, y), static_cast<std::size_t>(x1 - x0)};
  }
  [[nodiscard]] std::span<MeasuredPixel> row(int x0, int x1, int y) {
    return {pixels_.data() + rect_.index(x0, y), static_cast<std::size_t>(x1 - x0)};
  }
  /// All pixels, row by row.
  [[nodiscard]] const std::vector<MeasuredPixel>& pixels() const { return pixels_; }

  [[nodiscard]] Image image(Alpha alpha) const;
  /// Writes the same into `image`, a picture of the frame's pixels in `rect`. Precondition: `rect`
  /// holds these pixels.
  void copy_to(Image& image, const PixelRect& rect) const;
  [[nodiscard]] std::vector<float> noise() const;
  [[nodiscard]] std::vector<std::uint32_t> samples() const;

  /// The number of bytes of the pixels in `rect`.
  static std::uint64_t bytes(const PixelRect& rect) { return rect.area() * sizeof(MeasuredPixel); }

 private:
  PixelRect rect_;
  std::vector<MeasuredPixel> pixels_;
};

/// The progress of its pixels in `block`, which lies in the picture; `max_spp` as in NoiseTarget.
NoiseSoFar noise_so_far(const MeasuredPicture& picture, const PixelRect& block, int max_spp);

/// The number of its pixels that have samples.
std::uint64_t count_measured(const MeasuredPicture& picture);

/// The noise that a picture reached.
struct NoiseReached {
  double half_width = 0;    ///< the half-width that 95 % of the pixels stay within
  double mean_samples = 0;  ///< the mean number of samples of a pixel
  double share = 0;         ///< the fraction of pixels with fewer than the largest number of
                            ///< samples
};

/// The noise over the pixels with samples; all zeros without such pixels. `max_spp` as in
/// NoiseTarget.
NoiseReached noise_reached(const MeasuredPicture& picture, int max_spp);

/// The largest number of samples of a pixel: both halves have the same number.
constexpr std::uint32_t most_samples(int max_spp) {
  return static_cast<std::uint32_t>(max_spp / 2 * 2);
}

/// The half-width of a 95 % confidence interval in standard errors, the unit of `noise`.
inline constexpr double interval_in_errors = 1.96;

}  // namespace boule
