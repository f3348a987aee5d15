#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/shading/stream_surfaces.h"
#include "simd/abi/paths.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The direct light on the hits of a stream's rays, one light after the other: make_shadow_rays()
/// makes the shadow rays, and add_unblocked() adds the light of the unoccluded ones.
class Illumination {
 public:
  /// Forgets all hits, and makes room for one per ray.
  void start(std::size_t rays);

  /// Adds the hit of ray `ray` of the stream, which light may reach.
  void add_point(std::size_t ray, const FlatMaterial& material) {
    lit_[ray] = 1;
    materials_[ray] = &material;
    any_ = true;
  }

  /// The lecture's epsilon: its length, and the points in floats, by ray.
  struct Epsilon {
    float length;
    const Vec3f* points;
  };

  /// The shadow rays of the points that face the light, in the points' order; valid until the next
  /// call. `surfaces` holds all points. With an epsilon the rays start by it.
  RayStream make_shadow_rays(const KernelTable& kernels, const ShadowTarget& light,
                             StreamSurfaces& surfaces, const std::optional<Epsilon>& epsilon = {});

  /// One of the last shadow rays.
  [[nodiscard]] Ray shadow_ray(std::size_t k) const { return shadow_rays_.get(k); }

  /// Adds the light to radiance[ray] for every shadow ray k with blocked[k] = 0, where the shadow
  /// ray belongs to ray `ray`. The light is that of the last shadow rays.
  void add_unblocked(const KernelTable& kernels, const LightIntensity& light,
                     StreamSurfaces& surfaces, const std::uint8_t* blocked,
                     const ColorStream& radiance);

 private:
  void start_by(const Epsilon& epsilon, const ShadowTarget& light);

  std::size_t size_ = 0;  ///< number of rays
  bool any_ = false;
  AlignedArray<std::uint8_t> lit_;              ///< by ray
  std::vector<const FlatMaterial*> materials_;  ///< by ray
  // By shadow ray:
  std::size_t shadow_count_ = 0;
  RayBuffer shadow_rays_;
  VectorBuffer to_light_;
  AlignedArray<double> cosines_;      ///< n.l
  AlignedArray<std::uint32_t> rays_;  ///< the ray of its hit
};

}  // namespace boule
