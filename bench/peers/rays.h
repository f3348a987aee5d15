#pragma once

#include <string>
#include <vector>

#include "bench/bench_scenes.h"
#include "core/math/ray.h"
#include "simd/build/stream_buffer.h"

namespace boule::bench {

/// The questions asked. primary: the nearest hits of the camera's rays; shadow: whether the light
/// is hidden from them, one ray for each that faces it; diffuse: the nearest hits of one
/// cosine-distributed bounce from each.
enum class RayKind { primary, shadow, diffuse };

std::string name_of(RayKind kind);

/// The secondary rays of primary hits, in their order, made as the renderer makes them.
RayBuffer shadow_rays(const BenchScene& scene, const RayBuffer& primary,
                      const std::vector<Hit>& hits);
RayBuffer diffuse_rays(const BenchScene& scene, const RayBuffer& primary,
                       const std::vector<Hit>& hits);

}  // namespace boule::bench
