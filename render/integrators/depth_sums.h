#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "render/integrators/sample_faults.h"

namespace boule {

/// Radiance per sample, summed over each depth by itself and then from depth 0 on. Float sums
/// depend on their order; this one is the same however the rays of a depth were cut into streams,
/// as long as each depth's rays come in order.
class DepthSums {
 public:
  /// Forgets everything; from now on samples are 0 .. samples - 1.
  void start(std::size_t samples);

  /// The sums of one depth, one per sample, to be added to; valid until the next call. `depth` is
  /// not below what finish_below() was told.
  Color* at_depth(int depth);

  /// Promises that nothing more comes for depths below `depth`: their memory is used again.
  void finish_below(int depth);

  /// Writes the sums over all depths, settled().
  void finish(Color* radiance);

  /// What was wrong with the sums written so far, over all starts.
  [[nodiscard]] const SampleFaults& faults() const { return faults_; }

 private:
  std::size_t samples_ = 0;
  int first_depth_ = 0;                   ///< of rows_
  std::vector<std::vector<Color>> rows_;  ///< by depth - first_depth_
  std::vector<std::vector<Color>> spare_;
  std::vector<Color> total_;
  SampleFaults faults_;
};

}  // namespace boule
