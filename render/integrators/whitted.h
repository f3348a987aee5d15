#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/integrators/ray_record.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/material_finder.h"
#include "render/shading/path_material.h"

namespace boule {

/// Turner Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980: direct
/// light with hard shadows, mirror reflection and refraction, down to max_depth bounces.
class Whitted final : public StreamIntegrator {
 public:
  /// `scene` and `kernels` must outlive the integrator.
  Whitted(const PreparedScene& scene, const KernelTable& kernels,
          const IntegratorSettings& settings);

 private:
  /// The data of a block.
  struct Found {
    bool lit = false, scattering = false;
  };

  void make_room(std::size_t rays) override { materials_.start(rays); }
  void shade(const Block& block) override;
  Found meet_materials(const Block& block);
  void scatter_rays(const Block& block);
  void record_ray(const Block& block);
  void spawn(std::size_t parent, const Ray& ray, const Color& weight, RayKind kind);

  MaterialFinder<WhittedMaterial> materials_;
  // Working memory of one block.
  AlignedArray<std::uint8_t> scatters_;     ///< by ray
  std::vector<const FlatMaterial*> lobes_;  ///< by ray
  const FlatMaterial* recorded_ = nullptr;  ///< the material at the hit of the only ray
};

}  // namespace boule
