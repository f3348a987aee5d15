#pragma once

#include <cstdint>
#include <limits>

#include "render/integrators/integrator.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The id of a view that meets nothing.
inline constexpr std::uint32_t no_view_id = 4294967295;

/// What one camera ray meets, as numbers rather than light. As it stands here: a miss.
struct View {
  float depth = std::numeric_limits<float>::infinity();  ///< t64 |d|, Euclidean, finite for a hit
  Vec3f normal;    ///< geometric, unit length, turned towards the viewer as for shading; miss: 0
  Vec3f position;  ///< p64 rounded to float; miss: 0
  std::uint32_t id = no_view_id;  ///< the primitive's
  /// The share of light that the surface sends on: diffuse colour + weights of the reflected and
  /// the refracted ray, 1 at most. Highlights, ambient light and emission are none; miss: 0.
  Color albedo;
  /// The hit's distance from the eye along the view, L.(P - E): negative behind it, as fisheyes
  /// see.
  float along = std::numeric_limits<float>::infinity();
};

/// Finds views (also called AOVs, "arbitrary output variables"). One serves one thread and keeps
/// its working memory from call to call.
class Views {
 public:
  /// `scene` and `kernels` must outlive it.
  Views(const PreparedScene& scene, const KernelTable& kernels, Solver solver)
      : scene_(scene), kernels_(kernels), solver_(solver), geometry_(scene.geometry.view()) {}

  /// views[k] = what rays[k] meets, of any rays; as many views as rays: precondition. Throws
  /// std::bad_alloc.
  void trace(RayBuffer& rays, Coherence coherence, View* views);

  /// All rays traced so far.
  [[nodiscard]] RayCounts counts() const { return {primary_, 0, 0}; }

 private:
  const PreparedScene& scene_;
  const KernelTable& kernels_;
  Solver solver_;
  GeometryView geometry_;
  HitBuffer hits_;
  std::uint64_t primary_ = 0;
};

}  // namespace boule
