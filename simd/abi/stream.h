#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/platform.h"
#include "core/math/ray.h"

namespace boule {

/// The arrays that rays are kept in, one entry for each ray; meanings as in Ray. Array<T> is a
/// pointer in a view and an owner of memory in a buffer.
template <template <class> class Array>
struct RayArrays {
  Array<double> org_x, org_y, org_z;
  Array<float> dir_x, dir_y, dir_z;
  Array<float> tmin, tmax;
  Array<std::int32_t> source;  ///< id of the primitive the ray leaves, or no_primitive
  Array<std::uint8_t> inside;  ///< 1: it leaves `source`, a sphere, on its inside, from the surface
};

/// Calls visit(rays.org_x...), visit(rays.org_y...) and so on, once for each of the arrays. With
/// more than one set of rays visit() gets the same array of each.
template <class Visit, class... Rays>
BOULE_INLINE constexpr void each_array(const Visit& visit, Rays&... rays) {
  visit(rays.org_x...);
  visit(rays.org_y...);
  visit(rays.org_z...);
  visit(rays.dir_x...);
  visit(rays.dir_y...);
  visit(rays.dir_z...);
  visit(rays.tmin...);
  visit(rays.tmax...);
  visit(rays.source...);
  visit(rays.inside...);
}

template <class T>
using Pointer = T*;

/// Rays in memory as a structure of arrays: `size` rays, every array `padded(size)` long and
/// aligned to stream_alignment. A view: owns nothing, checks nothing.
struct RayStream : RayArrays<Pointer> {
  std::size_t size;
};

/// `size` rays from ray `first` on, a multiple of max_width. Precondition: the stream has them.
inline RayStream part(const RayStream& rays, std::size_t first, std::size_t size) {
  RayStream some = rays;
  each_array([first](auto& array) { array += first; }, some);
  some.size = size;
  return some;
}

/// Ray i of a stream, or of other RayArrays. Precondition: there is one.
template <class Rays>
Ray get_ray(const Rays& rays, std::size_t i) {
  Ray ray{{rays.org_x[i], rays.org_y[i], rays.org_z[i]},
          {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}};
  ray.tmin = rays.tmin[i];
  ray.tmax = rays.tmax[i];
  ray.source = rays.source[i];
  ray.inside = rays.inside[i] != 0;
  return ray;
}

/// Nearest hits, one per ray: t in double, unrounded, and the primitive's id; inf and -1 for a
/// miss. Of a sphere also the slot where it lies in the geometry; of other hits `slot` is anything.
/// Arrays as in RayStream.
struct HitStream {
  double* t;
  std::int32_t* id;
  std::uint32_t* slot;
  std::size_t size;
};

inline HitStream part(const HitStream& hits, std::size_t first, std::size_t size) {
  return {hits.t + first, hits.id + first, hits.slot + first, size};
}

/// Samples of the image plane to send primary rays through: raster coordinates, where (0, 0) is the
/// top left corner and pixel (i, j) has its centre at (i + 0.5, j + 0.5). Arrays as in RayStream.
/// Arrays that a camera does not use may be null: lens_x and lens_y without has_lens(), `weight`
/// unless the camera `weighs`.
struct SampleStream {
  double* raster_x;
  double* raster_y;
  double* lens_x;  ///< with lens_y a point of the lens, 0 .. 1 each; (0.5, 0.5) is its centre
  double* lens_y;
  float* weight;  ///< written: how much the ray's radiance counts; 0: there is no ray
  std::size_t size;
};

/// How many rays to hand over at once so that any_hit is fast in a scene of so many spheres. Of
/// more rays to one light, neighbours are closer together, and bundles of them visit fewer leaves;
/// that outweighs the caches, which more rays fill, once the spheres do not fit into them either.
/// Set by trial. Again, with other numbers here: bench_peers --scenes u100000,u1000000 --rays
/// shadow
constexpr std::size_t fitting_stream_size(std::size_t spheres) {
  return spheres > 262144 ? 65536 : 16384;
}

}  // namespace boule
