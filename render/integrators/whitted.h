#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/integrators/ray_record.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/material_finder.h"

namespace boule {

/// Turner Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980: direct
/// light with hard shadows, mirror reflection and refraction, down to max_depth bounces.
class Whitted final : public StreamIntegrator {
 public:
  /// `scene` and `kernels` must outlive the integrator.
  Whitted(const PreparedScene& scene, const KernelTable& kernels,
          const IntegratorSettings& settings);

 private:
  /// A ray of the block, and the material that it met, which sends light on.
  struct ScatteringHit {
    std::uint32_t ray;
    const FlatMaterial* material;
  };

  void make_room(std::size_t rays) override { materials_.start(rays); }
  void shade(const Block& block) override;
  void spawn_rays(const ScatteringHit& hit, const Surface& surface);
  void spawn(std::size_t parent, const Ray& ray, const Color& weight, RayKind kind);

  MaterialFinder<FlatMaterial> materials_;
  std::vector<ScatteringHit> scattering_hits_;  ///< working memory of one block
};

}  // namespace boule
