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

namespace boule {

/// Decides how many samples the pixels of a block get. Each pixel has two independent halves of
/// samples. Each half decides the number of samples of the *other* half, together with the first
/// samples of the pixels around. So the number of samples behind a half's mean is independent of
/// those samples, and the mean is unbiased, however rare the bright ones are. A pixel is the mean
/// of its halves' means. A pixel depends only on the `rim` pixels around it: blocks are rendered
/// with that rim, so their edges are invisible in the picture.
class NoiseBlock {
 public:
  static constexpr int largest = 64;  ///< side of a block, in pixels
  static constexpr int rim = 1;

  /// The second half has the random numbers of pixels this far to the right, beyond any frame.
  static constexpr int half_distance = 65536;
  /// From a sample's x: the column of its pixel, and its half.
  static int column(int x) { return x & (half_distance - 1); }
  static std::size_t half_of(int x) { return x < half_distance ? 0 : 1; }

  explicit NoiseBlock(const NoiseTarget& target);

  /// Begins a block of the frame. Precondition: its sides are at most `largest`.
  void begin(const PixelRect& block, const PixelRect& frame);
  /// The samples that are needed next: those of the halves of pixels in `wanted()`, from first() up
  /// to end().
  struct Half {
    std::int32_t x, y;  ///< the pixel; x has half_distance added for the second half
  };
  [[nodiscard]] const std::vector<Half>& wanted() const { return wanted_; }
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int end() const { return end_; }
  void add(const SampleId& id, const Color& sample, std::uint8_t covered) {
    at(column(id.x), id.y).halves[half_of(id.x)].add(sample, covered);
  }
  /// Call this once all wanted samples are added. Sets the pixels that have enough samples, and
  /// requests more for the others. Returns false if all have enough: the block is done.
  bool look(MeasuredPicture& picture);
  /// The pixels that the last look() set.
  [[nodiscard]] const NoiseSoFar& settled() const { return settled_; }

 private:
  struct Pixel {
    std::uint16_t x, y;  ///< of the frame
  };
  /// The results of a half that has all its samples. It may get more, to decide for the other half.
  struct Settled {
    PixelNumbers mean{}, variance{};
    int count = 0;  ///< 0: it still lacks samples
    int batches = 0;
  };
  struct State {
    std::array<SampleHalf, 2> halves;
    std::array<int, 2> goals{};  ///< the halves' numbers of samples; 0: undecided
    std::array<Settled, 2> settled;
    std::array<PixelNumbers, 2> variances;  ///< of the halves, at the last look
    PixelNumbers around{};  ///< mean variance of the first samples of the pixels around
  };

  State& at(int x, int y) { return states_[area_.index(x, y)]; }
  void look_around();
  [[nodiscard]] PixelNumbers variance_around(int x, int y);
  [[nodiscard]] PixelNumbers careful_variance(const State& state, std::size_t half) const;
  [[nodiscard]] double displayed(const PixelNumbers& mean, const PixelNumbers& half_width,
                                 double least) const;
  [[nodiscard]] bool is_enough(const State& state, std::size_t half, int count) const;
  [[nodiscard]] int decide(const State& state, std::size_t half) const;
  void find_variances();
  bool settle(State& state) const;
  void want_more(const Pixel& pixel);
  [[nodiscard]] MeasuredPixel measured(const State& state) const;

  const NoiseTarget target_;
  const double scale_;  ///< of the exposure
  const std::vector<PixelOffset> order_;
  PixelRect block_, area_;  ///< area: the block with its rim
  std::vector<State> states_;
  std::vector<Pixel> unsettled_;
  std::vector<Half> wanted_;
  int first_ = 0, end_ = 0;
  NoiseSoFar settled_;
};

}  // namespace boule
