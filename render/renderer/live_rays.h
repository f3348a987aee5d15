#pragma once

#include <cstddef>

#include "simd/stream/stream_buffer.h"

namespace boule {

/// Drops the rays whose samples weigh nothing; those that stay move up in their order. A ray that
/// is not there costs nothing.
inline void keep_live_rays(const SampleBuffer& samples, RayBuffer& rays) {
  std::size_t live = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples.weight(k) == 0) continue;
    if (live != k) rays.set(live, rays.get(k));
    ++live;
  }
  rays.resize(live);
}

}  // namespace boule
