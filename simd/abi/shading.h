#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/stream.h"

namespace boule {

/// Vectors in memory as a structure of arrays, as in RayStream. This stream and those below are
/// views: they own nothing and check nothing.
struct VectorStream {
  double* x;
  double* y;
  double* z;
};
inline VectorStream part(const VectorStream& vectors, std::size_t first) {
  return {vectors.x + first, vectors.y + first, vectors.z + first};
}

/// The surfaces at the hits of rays, one per ray, with arrays as in RayStream. Meanings are as in
/// Surface and, for rays that leave to the viewer's side, Departure (core/surface.h).
struct SurfaceStream {
  VectorStream point;
  VectorStream normal;
  VectorStream view;
  VectorStream mirrored;
  VectorStream org;  ///< origin of rays that leave
  double* cosine;
  double* reach;
  std::uint8_t* inner;
  std::uint8_t* inside;  ///< 1: rays leave on the inside of a sphere
};

/// The target of shadow rays: one point or one direction.
struct ShadowTarget {
  bool directional;
  double target[3];  ///< the point; if directional, the unit direction to the light
  float dir[3];      ///< direction of the shadow rays, if directional
};

/// Points of a SurfaceStream that light may reach. The arrays are padded with unlit points.
struct LitStream {
  VectorStream point;
  VectorStream normal;
  VectorStream org;
  const std::int32_t* id;
  const std::uint8_t* inside;
  const std::uint8_t* lit;  ///< 1: light may reach the point
  std::size_t size;
};

/// Shadow rays to a light, packed. Each has the index of its point, the unit direction to the light
/// and the cosine n.l. Arrays have room for all points, padded; rays.size is ignored. The rays
/// share no numbers.
struct ShadowRayStream {
  RayStream rays;
  VectorStream to_light;
  double* cosine;
  std::uint32_t* point;
};

/// Points of Sobol's sequence by sample and seeds: sobol_point() of core/math/sobol.h. Arrays are
/// as in RayStream.
struct SobolStream {
  const std::uint32_t* sample;
  const std::uint32_t* shuffle;
  const std::uint32_t* seed_u;
  const std::uint32_t* seed_v;
  double* u;  ///< output, with v
  double* v;
  std::size_t size;
};

}  // namespace boule
