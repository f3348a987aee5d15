#pragma once

#include <cstddef>

#include "bench/bench_scenes.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// The pixel centres of a picture of side x side along the Morton curve: 16x16 tiles one after the
/// other, and within each any 4, 8, 16 consecutive pixels in a block (of a side that is a power of
/// two; of others what is left of the curve).
SampleBuffer pixel_centers(int side);

/// The camera's rays through these, in their order, by Boule's widest kernel.
RayBuffer primary_rays(const BenchScene& scene, int side);

}  // namespace boule::bench
