#pragma once

#include <cstdint>
#include <vector>

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
  /// A ray of the current stream that goes on from what it hit.
  struct Point {
    std::size_t ray;
    const FlatMaterial* material;
  };

  void shade(const Block& block) override;
  void go_on(std::size_t ray, const FlatMaterial& material, const Surface& surface);

  std::vector<Point> points_;  ///< working memory of one block
};

}  // namespace boule
