#pragma once

#include <string>
#include <vector>

#include "bench/bench_scenes.h"
#include "core/math/ray.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// Kinds of rays. primary: nearest hits of the camera's rays. From each primary hit: shadow: any
/// hit on the way to the light, if the surface faces it; mirror: the nearest hit of the mirrored
/// ray; diffuse: the nearest hit of a cosine-distributed bounce; light: any hit on the way to a
/// random point of a ball of radius 0.25 around the light.
enum class RayKind { primary, shadow, mirror, diffuse, light };

/// All of them.
std::vector<RayKind> ray_kinds();

std::string name_of(RayKind kind);

/// Whether rays of this kind are traced for any hit instead of the nearest.
constexpr bool asks_any(RayKind kind) { return kind == RayKind::shadow || kind == RayKind::light; }

/// The secondary rays of primary hits, in their order, made as the renderer makes them.
RayBuffer secondary_rays(RayKind kind, const BenchScene& scene, const RayBuffer& primary,
                         const std::vector<Hit>& hits);

}  // namespace boule::bench
