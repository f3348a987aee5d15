#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "core/scene/light.h"
#include "render/prepare/flat_material.h"
#include "render/shading/stream_surfaces.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Direct light on the points that a stream's rays met, one light after the other: aim() makes the
/// shadow rays, add_unblocked() takes their answers. One serves one thread and keeps its memory
/// from stream to stream.
class Illumination {
 public:
  /// Forgets all points, and makes room for one per ray. Throws std::bad_alloc.
  void start(std::size_t rays);

  /// Light may fall on the point that ray `ray` of the stream met.
  void add_point(std::size_t ray, const FlatMaterial& material) {
    lit_[ray] = 1;
    materials_[ray] = &material;
    any_ = true;
  }

  /// The shadow rays of the points that face the light, in the points' order; valid until the next
  /// call. All points are found in `surfaces`.
  RayStream aim(const KernelTable& kernels, const ShadowTarget& light, StreamSurfaces& surfaces);

  /// Adds what arrives of the light that was aimed at last to radiance[ray], for every shadow ray k
  /// whose blocked[k] is 0.
  void add_unblocked(const Light& light, const StreamSurfaces& surfaces,
                     const std::uint8_t* blocked, Color* radiance) const;

 private:
  template <class AnyLight>
  void add_light(const AnyLight& light, const StreamSurfaces& surfaces, const std::uint8_t* blocked,
                 Color* radiance) const;

  std::size_t size_ = 0;  ///< rays
  bool any_ = false;
  AlignedArray<std::uint8_t> lit_;              ///< by ray
  std::vector<const FlatMaterial*> materials_;  ///< by ray
  // By shadow ray.
  std::size_t aimed_ = 0;
  RayBuffer shadow_rays_;
  VectorBuffer to_light_;
  AlignedArray<double> cosines_;      ///< n.l
  AlignedArray<std::uint32_t> rays_;  ///< whose point it is
};

}  // namespace boule
