#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "render/integrators/sample_faults.h"
#include "simd/abi/paths.h"

namespace boule {

/// The number of rays per depth of a sample.
enum class RaysPerDepth { one_at_most, many };

/// The radiance of samples. It is summed per depth, and then over the depths from 0 on. A float sum
/// depends on its order. This sum is the same for any partition of a depth's rays into streams, as
/// long as they come in order. If a sample has one ray of each depth, and the ray of a lower depth
/// comes first, sums per depth would equal the rays' own numbers, so they are left out.
class DepthSums {
 public:
  explicit DepthSums(RaysPerDepth rays = RaysPerDepth::many) : rays_(rays) {}

  /// Clears all sums. From now on the samples are 0 .. samples - 1.
  void start(std::size_t samples);

  /// The sums of one depth, one per sample, to which the caller adds; valid until the next call.
  /// Precondition: `depth` is at least that of the last finish_below().
  ColorSum* at_depth(int depth);

  /// Adds up the depths below `depth`, which are complete.
  void finish_below(int depth);

  /// Writes the sum over all depths of each sample, settled().
  void finish(Color* radiance);

  /// The faults in all sums that were written so far.
  [[nodiscard]] const SampleFaults& faults() const { return faults_; }

 private:
  RaysPerDepth rays_;
  std::size_t samples_ = 0;
  int first_depth_ = 0;                      ///< the depth of rows_[0]
  std::vector<std::vector<ColorSum>> rows_;  ///< by depth - first_depth_
  std::vector<std::vector<ColorSum>> spare_;
  std::vector<ColorSum> total_;
  bool has_total_ = false;  ///< the sums of the first depth become the total
  SampleFaults faults_;
};

}  // namespace boule
