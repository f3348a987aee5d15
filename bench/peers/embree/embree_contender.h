#pragma once

#include "bench/peers/contender.h"
#include "bench/peers/embree/embree_version.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

/// The rays per call to Embree, or a stream of single rays (embree_has_streams).
enum class EmbreeCall { rays1, rays4, rays8, rays16, stream };

/// Rays of one stream: 80 KiB, in the second-level cache.
inline constexpr std::size_t embree_stream_size = 1024;

class EmbreeContender final : public Contender {
 public:
  /// `memory` is shared with other contenders: it holds the rays of the last one to prepare.
  EmbreeContender(Info info, const Workload& workload, RTCScene scene, EmbreeCall call,
                  EmbreeHint hint, AlignedArray<float>& memory);

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
  EmbreeHint hint_;
  std::size_t group_;   ///< rays in one structure
  std::size_t fields_;  ///< 12 of a ray, and for the nearest hit those of a hit
  AlignedArray<float>& memory_;
};

/// A ray as Embree takes it: float origin, unit float direction. Embree cannot be told which
/// surface a ray leaves, so secondary rays begin 1e-5 from their origin. The scenes have size 1, so
/// that is 170 u, and the radius of the smallest spheres is 70 times as large, that of the thinnest
/// capsules 37 times.
struct EmbreeRay {
  float org[3], tnear, dir[3], tfar;
};
EmbreeRay embree_ray(const Ray& ray);

/// Converts t along Embree's unit direction to t along the ray's own direction.
double ray_t(const Ray& ray, double embree_t);

}  // namespace boule::bench
