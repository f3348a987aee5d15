#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/stream.h"

namespace boule {

/// Spheres by id, wherever they are: the centre's coordinates and the radius are the four floats
/// from first + id stride on. A view, as all here: it owns nothing and checks nothing, what it
/// points to is as long as it says (kernel_table.h).
struct SphereRows {
  const float* first;
  std::size_t stride;
};

/// Vectors in memory as a structure of arrays, as in RayStream.
struct VectorStream {
  double* x;
  double* y;
  double* z;
};
inline VectorStream part(const VectorStream& vectors, std::size_t first) {
  return {vectors.x + first, vectors.y + first, vectors.z + first};
}

/// Where rays met primitives, one per ray, arrays as in RayStream. Meanings as in Surface and, for
/// rays that leave to the viewer's side, Departure (core/surface.h).
struct SurfaceStream {
  VectorStream point;
  VectorStream normal;
  VectorStream view;
  VectorStream mirrored;
  VectorStream org;  ///< where rays leave
  double* cosine;
  double* reach;
  std::uint8_t* inner;
  std::uint8_t* inside;  ///< 1: rays leave on the inside of a sphere
};

/// A light that shines from one point, or from one direction.
struct LightPlace {
  bool directional;
  double place[3];  ///< its point; the unit direction to it, where it is directional
  float way[3];     ///< the direction of shadow rays, where it is directional
};

/// Points on which light may fall: of a SurfaceStream. Arrays are padded with points that are not
/// lit.
struct LitStream {
  VectorStream point;
  VectorStream normal;
  VectorStream org;
  const std::int32_t* id;
  const std::uint8_t* inside;
  const std::uint8_t* lit;  ///< 1: light may fall on it
  std::size_t size;
};

/// Shadow rays to a light, one after the other, each with its point's number, the unit direction to
/// the light and n.l. Arrays have room for all points, padded; rays.size does not count.
struct AimedStream {
  RayStream rays;
  VectorStream to_light;
  double* cosine;
  std::uint32_t* point;
};

/// Places in Sobol's sequence by sample and seeds, as core/math/sobol.h has them. Arrays as in
/// RayStream.
struct SobolStream {
  const std::uint32_t* sample;
  const std::uint32_t* shuffle;
  const std::uint32_t* seed_u;
  const std::uint32_t* seed_v;
  double* u;  ///< written, with v
  double* v;
  std::size_t size;
};

/// Directions at an angle from an axis, given by its cosine and sine, and so many turns around it,
/// 0 <= turns <= 1: direction_about() of core/math/warp.h. Arrays as in RayStream.
struct TurnStream {
  VectorStream axis;
  const double* cosine;
  const double* sine;
  const double* turns;
  VectorStream direction;  ///< written
  std::size_t size;
};

/// Spheres that are sought from points, each in a direction by two numbers: a LightCone
/// (core/light_cone.h). Arrays as in RayStream.
struct SeekStream {
  VectorStream org;
  VectorStream center;
  const double* radius;
  const double* u;
  const double* v;
  VectorStream direction;  ///< written: unit length; anything where the density is 0
  double* density;         ///< written
  float* tmax;             ///< written: of the shadow ray that way
  std::size_t size;
};

}  // namespace boule
