#pragma once

#include <cstddef>

#include "simd/stream/stream_buffer.h"

namespace boule {

/// Removes the rays of samples with weight 0, so that they are not traced. The others keep their
/// order.
inline void keep_live_rays(const SampleBuffer& samples, RayBuffer& rays) {
  std::size_t live = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples.weight(k) == 0) continue;
    if (live != k) rays.set(live, rays.get(k));
    ++live;
  }
  rays.shrink(live);
}

}  // namespace boule
