#pragma once

#include <cstddef>

#include "render/integrators/ray_record.h"
#include "render/integrators/stream_integrator.h"

namespace boule {

/// Turner Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980: direct
/// light with hard shadows, mirror reflection and refraction, down to max_depth bounces.
class Whitted final : public StreamIntegrator {
 public:
  /// `scene` and `kernels` must outlive the integrator.
  Whitted(const PreparedScene& scene, const KernelTable& kernels,
          const IntegratorSettings& settings);

 private:
  void shade(const Block& block) override;
  void spawn_rays(const ScatteringHit& hit, const Surface& surface);
  void spawn(std::size_t parent, const Ray& ray, const Color& weight, RayKind kind);
};

}  // namespace boule
