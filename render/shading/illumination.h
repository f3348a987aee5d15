#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "core/scene/light.h"
#include "render/prepare/flat_material.h"
#include "render/shading/surface.h"
#include "simd/build/aligned_array.h"
#include "simd/build/stream_buffer.h"

namespace boule {

/// Direct light on the points that a stream's rays met, one light after the other: aim() makes the
/// shadow rays, add_unblocked() takes their answers. An array for every number, so that lights turn
/// to many points at once. One serves one thread and keeps its memory from stream to stream.
class Illumination {
 public:
  /// Forgets all points, and makes room for one per ray. Throws std::bad_alloc.
  void start(std::size_t rays);

  /// A point on which light may fall, met by ray `ray` of the stream.
  void add_point(std::uint32_t ray, const FlatMaterial& material, const Surface& surface);

  /// The shadow rays of the points that face the light, in the points' order; valid until the next
  /// call.
  RayStream aim(const Light& light);

  /// Adds what arrives of the light that was aimed at last to radiance[ray], for every shadow ray k
  /// whose blocked[k] is 0.
  void add_unblocked(const Light& light, const std::uint8_t* blocked, Color* radiance) const;

 private:
  struct Vectors {
    AlignedArray<double> x, y, z;
    void resize(std::size_t size);
    void set(std::size_t i, const Vec3d& v);
    [[nodiscard]] Vec3d get(std::size_t i) const { return {x[i], y[i], z[i]}; }
  };
  struct Origin {
    const FlatMaterial* material;
    std::uint32_t ray;
    std::int32_t source;
    bool inside;
  };
  /// Light that arrives at a point unless its shadow ray is blocked.
  struct Arrival {
    Vec3d to_light;
    double cosine;  ///< n.l
    std::size_t point;
  };

  template <class AnyLight>
  std::size_t aim_at(AnyLight light);
  template <class AnyLight>
  void add_light(const AnyLight& light, const std::uint8_t* blocked, Color* radiance) const;

  std::size_t size_ = 0;  ///< points
  Vectors points_, normals_, mirrored_;
  Vectors orgs_;  ///< the points, moved off their surfaces
  std::vector<Origin> origins_;
  RayBuffer shadow_rays_;
  std::vector<Arrival> arrivals_;  ///< by shadow ray
  std::size_t aimed_ = 0;          ///< shadow rays
};

}  // namespace boule
