#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/paths.h"
#include "simd/abi/shading.h"

namespace boule {

/// What the kernels of Whitted's method and of direct light read. All streams are views, as those
/// of paths.h.

/// The rays of a block, and the hits from which mirrored and refracted rays go on. By ray.
struct ScatteringHits {
  const std::uint8_t* scatters;         ///< 1: from this one; else 0, also up to padded(size)
  SurfaceStream surfaces;               ///< of those
  const LobeMaterial* const* material;  ///< of those
  const std::int32_t* id;               ///< what was hit
  std::int32_t first_plane;             ///< ids below it are spheres'
  ColorStream throughput;
  const std::uint32_t* sample;
  std::size_t size;
};

/// What a light sends to points: everywhere the same or, if it falls off, that times `strength`
/// over the squared distance of `position`.
struct LightIntensity {
  float intensity[3];
  bool falls_off;
  double position[3];
  double strength;
};

/// Shadow rays to one light, with what blocks them, and the points that they leave.
struct ShadowedPoints {
  const std::uint8_t* blocked;  ///< by shadow ray: 0 if nothing does
  VectorStream to_light;        ///< by shadow ray, unit length
  const double* cosine;         ///< by shadow ray: n.l
  const std::uint32_t* ray;  ///< by shadow ray: that to which its point belongs; none comes twice
  std::size_t size;
  VectorStream point, mirrored;         ///< by ray, as Surface has them
  const LobeMaterial* const* material;  ///< by ray
};

}  // namespace boule
