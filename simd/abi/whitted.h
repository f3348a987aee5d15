#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/paths.h"
#include "simd/abi/shading.h"

namespace boule {

/// The inputs of the kernels of Whitted's method and of direct light. All streams are views, as
/// those of paths.h.

/// The rays of a block and the hits from which mirrored and refracted rays continue. By ray.
struct ScatteringHits {
  const std::uint8_t* scatters;         ///< 1: rays continue from this hit; 0 otherwise, also up to
                                        ///< padded(size)
  SurfaceStream surfaces;               ///< of hits that scatter
  const FlatMaterial* const* material;  ///< of hits that scatter
  const std::int32_t* id;               ///< id of the primitive that was hit
  std::int32_t first_plane;             ///< the lowest id of a plane
  std::uint32_t planes;                 ///< how many there are; all others have an inside
  ColorStream throughput;
  const std::uint32_t* sample;
  std::size_t size;
};

/// The intensity of a light at a point: constant or, if the light falls off, `intensity` times
/// `strength` over the squared distance to `position`.
struct LightIntensity {
  float intensity[3];
  bool falls_off;
  double position[3];
  double strength;
};

/// Shadow rays to one light, whether they are blocked, and the points that they leave.
struct ShadowedPoints {
  const std::uint8_t* blocked;  ///< by shadow ray: 0 if it is unoccluded
  VectorStream to_light;        ///< by shadow ray, unit length
  const double* cosine;         ///< by shadow ray: n.l
  const std::uint32_t* ray;     ///< by shadow ray: index of the ray of its point; each occurs once
  std::size_t size;
  VectorStream point, mirrored;         ///< by ray, as in Surface
  const FlatMaterial* const* material;  ///< by ray
};

}  // namespace boule
