#pragma once

#include <string>
#include <vector>

#include "bench/scenes/bench_scenes.h"
#include "core/math/ray.h"
#include "simd/abi/isa.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// Kinds of rays. primary: nearest hits of the camera's rays. From each primary hit: shadow: any
/// hit on the way to the light, if the surface faces it; mirror: the nearest hit of the mirrored
/// ray; diffuse: the nearest hit of a cosine-distributed bounce; light: any hit on the way to a
/// random point of a ball of radius 0.25 around the light; ambient: any hit within a tenth of the
/// scene's radius, in the direction of such a bounce (ambient occlusion). orthographic: nearest
/// hits of parallel rays that show about what the camera shows. chord: nearest hits on the way from
/// one random point of the sphere around the scene to another.
enum class RayKind { primary, shadow, mirror, diffuse, light, ambient, orthographic, chord };

/// All of them.
std::vector<RayKind> ray_kinds();

std::string name_of(RayKind kind);

/// Whether rays of this kind are traced for any hit instead of the nearest.
constexpr bool asks_any(RayKind kind) {
  return kind == RayKind::shadow || kind == RayKind::light || kind == RayKind::ambient;
}

/// What the renderer promises of rays of a kind.
Coherence coherence_of(RayKind kind);

/// The camera's rays of a picture and what they hit, from which others are made.
struct PrimaryRays {
  int side = 0;  ///< pixels
  const RayBuffer* rays = nullptr;
  const std::vector<Hit>* hits = nullptr;
};

/// The rays of a kind, not the primary ones. Secondary rays are in the order of the hits and made
/// as the renderer makes them; of the others there are as many as primary ones.
RayBuffer make_rays(RayKind kind, const BenchScene& scene, const PrimaryRays& primary);

}  // namespace boule::bench
