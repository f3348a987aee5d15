#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// Rays in memory as a structure of arrays: `size` rays, every array `padded(size)` long and
/// aligned to stream_alignment. Meanings as in Ray. A view: owns nothing, checks nothing.
struct RayStream {
  double* org_x;
  double* org_y;
  double* org_z;
  float* dir_x;
  float* dir_y;
  float* dir_z;
  float* tmin;
  float* tmax;
  std::int32_t* source;  ///< primitive id the ray leaves, or -1
  std::uint8_t* inside;  ///< 1: it leaves `source`, a sphere, on its inside, from the surface
  std::size_t size;
};

/// Rays from `first`, a multiple of max_width, on. Nobody checks that there are so many.
inline RayStream part(const RayStream& r, std::size_t first, std::size_t size) {
  return {r.org_x + first,
          r.org_y + first,
          r.org_z + first,
          r.dir_x + first,
          r.dir_y + first,
          r.dir_z + first,
          r.tmin + first,
          r.tmax + first,
          r.source + first,
          r.inside + first,
          size};
}

/// Nearest hits, one per ray: t in double, unrounded, and the primitive's id; inf and -1 for a
/// miss. Arrays as in RayStream.
struct HitStream {
  double* t;
  std::int32_t* id;
  std::size_t size;
};

inline HitStream part(const HitStream& hits, std::size_t first, std::size_t size) {
  return {hits.t + first, hits.id + first, size};
}

/// Places on the image plane to send primary rays through: raster coordinates, (0, 0) the top left
/// corner, pixel (i, j) centred on (i + 0.5, j + 0.5). Arrays as in RayStream. What a camera does
/// not ask for may be null: the lens of one that has none, the weights of one that does not weigh.
struct SampleStream {
  double* raster_x;
  double* raster_y;
  double* lens_x;  ///< 0 .. 1 with lens_y; the middle, (0.5, 0.5), is the lens' centre
  double* lens_y;
  float* weight;  ///< written: how much the ray's radiance counts; 0: there is no ray
  std::size_t size;
};

/// Rays per stream that suit any hit among so many spheres: more rays of a light are closer
/// together, which pays for their memory where spheres do not fit into caches either.
constexpr std::size_t fitting_stream_size(std::size_t spheres) {
  return spheres > 262144 ? 65536 : 16384;
}

}  // namespace boule
