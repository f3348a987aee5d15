#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "core/math/sample_id.h"
#include "render/frame/measured_picture.h"
#include "render/frame/pixel_noise.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/frame/progress.h"
#include "render/renderer/small_spheres.h"

namespace boule {

/// The target for the edges of a picture without noise. A pixel has one sample, through its centre,
/// unless that differs from one of the eight around it by more than `step` in some channel as
/// displayed: multiplied by 2^exposure_stops, clamped to 0..1 and with the sRGB curve, in codes of
/// 0..255. Alpha, which has no curve, counts in pictures that have it.
struct EdgeTarget {
  float step = 0;    ///< codes, 0..255; 0: no target, all pixels get the same number of samples
  int max_spp = 64;  ///< the largest number of samples of a pixel, >= 1
  float exposure_stops = 0;
  bool alpha = false;
};

/// Decides how many samples the pixels of a block get in a picture without noise. A pixel at an
/// edge gets 4 samples, 8, 16 and so on, until the error of their mean, as their own spread tells,
/// is at most 3/10 (n/8)^(3/4) of the target's step. At a strong edge, where four samples may all
/// miss a corner of the pixel, it gets 8 at least, and 16 where small spheres may hide. So a pixel
/// with one sample is that of a picture with --spp 1, and one with n is that of --spp n, if those
/// leave out rays of the same weight (left_out_weight()). A pixel depends only on the `rim` pixels
/// around it: blocks are rendered with that rim.
class EdgeBlock {
 public:
  static constexpr int largest = 128;  ///< side of a block, in pixels
  static constexpr int rim = 1;
  static constexpr int center = -1;  ///< the number of the sample through a pixel's centre

  /// `small_spheres` must outlive it.
  EdgeBlock(const EdgeTarget& target, const SmallSpheres& small_spheres);

  /// Begins a block of the frame. Precondition: its sides are at most `largest`.
  void begin(const PixelRect& block, const PixelRect& frame);
  /// The samples that are needed next: those of the pixels in `wanted()`, from first() up to end().
  struct Pixel {
    std::int32_t x, y;  ///< of the frame
  };
  [[nodiscard]] const std::vector<Pixel>& wanted() const { return wanted_; }
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int end() const { return end_; }
  void add(const SampleId& id, const Color& sample, std::uint8_t covered);
  /// Call this once all wanted samples are added. Sets the pixels that have enough samples, and
  /// requests more for the others. Returns false if all have enough: the block is done.
  bool look(MeasuredPicture& picture);
  /// The pixels that the last look() set.
  [[nodiscard]] const NoiseSoFar& settled() const { return settled_; }

 private:
  /// The codes of a colour and its alpha, or steps of them.
  using Codes = std::array<std::uint8_t, 4>;
  /// The samples of a pixel at an edge.
  struct Samples {
    PixelNumbers sum{}, squares{};
    int count = 0;
    int least = 0;  ///< so many it gets at least
  };

  [[nodiscard]] bool in_block(const Pixel& p) const {
    return p.x >= block_.x0 && p.x < block_.x1 && p.y >= block_.y0 && p.y < block_.y1;
  }
  void add_center(const SampleId& id, const Color& sample, std::uint8_t covered);
  void find_steps();
  void widen_steps(int y, int dx, int dy);
  bool settle_center(const Pixel& pixel, MeasuredPicture& picture);
  bool settle(const Pixel& pixel, MeasuredPicture& picture);
  [[nodiscard]] int least_samples(const Pixel& pixel) const;
  [[nodiscard]] double error_of(const Samples& samples) const;
  void set(const Pixel& pixel, const MeasuredPixel& done, MeasuredPicture& picture);

  const EdgeTarget target_;
  const SmallSpheres& small_spheres_;
  const float scale_;  ///< of the exposure
  const std::vector<PixelOffset> order_;
  PixelRect block_, area_;            ///< area: the block with its rim
  std::vector<Codes> codes_;          ///< of the centres, by pixel of the area
  std::vector<Codes> steps_;          ///< the greatest to the centres around, by pixel of the block
  std::vector<Color> centers_;        ///< by pixel of the block
  std::vector<std::uint32_t> index_;  ///< into samples_, by pixel of the block
  std::vector<Samples> samples_;
  std::vector<Pixel> wanted_;
  int first_ = 0, end_ = 0;
  NoiseSoFar settled_;
};

}  // namespace boule
