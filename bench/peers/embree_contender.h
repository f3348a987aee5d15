#pragma once

#include <embree3/rtcore.h>

#include "bench/peers/contender.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

/// How Embree is asked: so many rays a call, or a stream of single rays.
enum class EmbreeCall { rays1, rays4, rays8, rays16, stream };

/// Rays of one stream: 80 KiB, in the second-level cache.
inline constexpr std::size_t embree_stream_size = 1024;

class EmbreeContender final : public Contender {
 public:
  /// `memory`: shared with others; whoever has prepared owns it.
  EmbreeContender(Info info, const Workload& workload, RTCScene scene, EmbreeCall call,
                  RTCIntersectContextFlags coherence, AlignedArray<float>& memory);

  void prepare() override;
  void trace(std::size_t first, std::size_t last) override;
  void answer(Answers& answers) const override;

 private:
  /// Field 0 of ray i in Embree's structures; field k lies k group_ further on.
  [[nodiscard]] std::size_t place(std::size_t i) const {
    return i / group_ * group_ * fields_ + i % group_;
  }
  void put(std::size_t i, const Ray& ray);

  Workload workload_;
  RTCScene scene_;
  EmbreeCall call_;
  RTCIntersectContextFlags coherence_;
  std::size_t group_;   ///< rays in one structure
  std::size_t fields_;  ///< 12 of a ray, and for the nearest hit 8 of a hit
  AlignedArray<float>& memory_;
};

/// What Embree gets of a ray: float origin, unit float direction. It cannot be told which surface a
/// ray leaves, so secondary rays begin at 1e-5 from their origin, in the scene's units: the scenes
/// are of size 1, 1e-5 is 170 u, and the smallest spheres are 70 times as large.
struct EmbreeRay {
  float org[3], tnear, dir[3], tfar;
};
EmbreeRay embree_ray(const Ray& ray);

/// t of Embree's along its unit direction as t of the ray's own.
double ray_t(const Ray& ray, double embree_t);

}  // namespace boule::bench
