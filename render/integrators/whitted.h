#pragma once

#include <cstdint>
#include <vector>

#include "render/integrators/integrator.h"
#include "render/integrators/wavefront.h"
#include "render/prepare/prepared_scene.h"
#include "render/shading/illumination.h"
#include "render/shading/surface.h"
#include "simd/abi/kernel_table.h"
#include "simd/build/aligned_array.h"

namespace boule {

/// Turner Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980: direct
/// light with hard shadows, mirror reflection and refraction, down to max_depth bounces.
class Whitted final : public Integrator {
 public:
  /// `scene` and `kernels` must outlive the integrator.
  Whitted(const PreparedScene& scene, const KernelTable& kernels,
          const IntegratorSettings& settings);

  bool trace(const CameraRays& camera, Color* radiance) override;
  [[nodiscard]] RayCounts counts() const override {
    return {primary_, shadow_, wavefront_.spawned()};
  }

 private:
  /// A ray of the current stream that goes on from what it hit.
  struct Point {
    std::uint32_t ray;
    const FlatMaterial* material;
    Surface surface;
  };

  void shade(const PathStream& stream, Coherence coherence);
  void make_room(std::size_t rays);
  void find_points(const PathStream& stream, Coherence coherence);
  void add_light(const Light& light);
  void continue_from(const Point& point);
  [[nodiscard]] bool cancelled() const;

  const PreparedScene& scene_;
  const KernelTable& kernels_;
  IntegratorSettings settings_;
  GeometryView geometry_;
  Wavefront wavefront_;
  std::uint64_t primary_ = 0, shadow_ = 0;

  // Working memory of one stream.
  HitBuffer hits_;
  std::vector<Point> points_;
  std::vector<Color> radiance_;  ///< by ray
  Illumination illumination_;
  AlignedArray<std::uint8_t> occluded_;
};

}  // namespace boule
