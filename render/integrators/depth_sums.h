#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/math/color.h"

namespace boule {

/// A component the film can hold: NaN becomes 0, infinity the largest float.
inline float film_value(float x) {
  constexpr float largest = std::numeric_limits<float>::max();
  if (x < largest) return x;
  return x >= largest ? largest : 0.0f;
}
inline Color film_value(const Color& c) {
  return {film_value(c.r), film_value(c.g), film_value(c.b)};
}

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

  /// Writes the sums over all depths.
  void finish(Color* radiance);

 private:
  std::size_t samples_ = 0;
  int first_depth_ = 0;                   ///< of rows_
  std::vector<std::vector<Color>> rows_;  ///< by depth - first_depth_
  std::vector<std::vector<Color>> spare_;
  std::vector<Color> total_;
};

}  // namespace boule
