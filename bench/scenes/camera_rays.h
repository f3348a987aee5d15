#pragma once

#include <cstddef>

#include "bench/scenes/bench_scenes.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// The pixel centres of a picture of side x side in Morton order: 16x16 tiles one after the other,
/// and within each tile any 4, 8 or 16 consecutive pixels form a block. If the side is no power of
/// two, the points of the curve outside the picture are left out.
SampleBuffer pixel_centers(int side);

/// The camera's rays through these points, in the same order, by Boule's widest kernel.
RayBuffer primary_rays(const BenchScene& scene, int side);

/// Parallel rays likewise, which show what the camera shows at the distance that it looks at.
RayBuffer parallel_rays(const BenchScene& scene, int side);

}  // namespace boule::bench
