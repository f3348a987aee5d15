#pragma once

#include <string>
#include <vector>

#include "bench/bench_scenes.h"
#include "core/math/ray.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// The questions asked. primary: the nearest hits of the camera's rays; shadow: whether the light
/// is hidden from them, one ray for each that faces it; mirror: the nearest hits of one mirrored
/// ray from each; diffuse: of one cosine-distributed bounce; light: whether a random point of a
/// ball of radius 0.25 around the light is hidden.
enum class RayKind { primary, shadow, mirror, diffuse, light };

/// All of them.
std::vector<RayKind> ray_kinds();

std::string name_of(RayKind kind);

/// Whether only any hit is asked for.
constexpr bool asks_any(RayKind kind) { return kind == RayKind::shadow || kind == RayKind::light; }

/// The secondary rays of primary hits, in their order, made as the renderer makes them.
RayBuffer secondary_rays(RayKind kind, const BenchScene& scene, const RayBuffer& primary,
                         const std::vector<Hit>& hits);

}  // namespace boule::bench
