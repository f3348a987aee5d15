#pragma once

#include <cstdint>
#include <limits>

#include "render/integrators/integrator.h"
#include "render/integrators/scene_search.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The id of a ray that misses.
inline constexpr std::uint32_t no_aov_id = 4294967295;

/// The hit of one camera ray, as numbers rather than light ("arbitrary output variables"). The
/// defaults are those of a miss.
struct Aovs {
  /// Euclidean distance of the hit from the ray's origin; finite for every hit.
  float depth = std::numeric_limits<float>::infinity();
  Vec3f normal{};    ///< geometric, unit length, towards the viewer, as for shading; miss: 0
  Vec3f position{};  ///< the hit's point, rounded to float; miss: 0
  std::uint32_t id = no_aov_id;  ///< the primitive's: spheres in order, then planes, then capsules
  /// The fraction of light that the surface sends on: the diffuse colour plus the weights of the
  /// reflected and the refracted ray, at most 1. Highlights, ambient light and emission are left
  /// out. Miss: 0.
  Color albedo{};
  /// The hit's distance from the eye along the camera's view direction L, which is L.(P - E). A
  /// fisheye also sees points behind the eye; there it is negative.
  float along = std::numeric_limits<float>::infinity();
};

/// Finds the AOVs of camera rays. It keeps its working memory from call to call.
class AovTracer {
 public:
  /// `scene` and `kernels` must outlive it.
  AovTracer(const PreparedScene& scene, const KernelTable& kernels, Solver solver)
      : scene_(scene), solver_(solver), search_(scene, kernels) {}

  /// Sets aovs[k] to the hit of rays[k]. Takes any rays. Precondition: `aovs` has room for one per
  /// ray.
  void trace(RayBuffer& rays, Coherence coherence, Aovs* aovs);

  /// All rays that were traced so far.
  [[nodiscard]] RayCounts counts() const { return {.primary = primary_}; }

 private:
  const PreparedScene& scene_;
  Solver solver_;
  SceneSearch search_;
  HitBuffer hits_, caps_;
  std::uint64_t primary_ = 0;
};

}  // namespace boule
