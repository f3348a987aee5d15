#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/platform.h"
#include "core/math/ray.h"
#include "simd/abi/isa.h"

namespace boule {

/// The arrays of rays, one entry per ray, with meanings as in Ray. Array<T> is a pointer in a view
/// and owns memory in a buffer.
template <template <class> class Array>
struct RayArrays {
  Array<double> org_x, org_y, org_z;
  Array<float> dir_x, dir_y, dir_z;
  Array<float> tmin, tmax;
  Array<std::int32_t> source;  ///< id of the primitive the ray leaves, or no_primitive
  Array<std::uint8_t>
      inside;  ///< 1: it leaves `source`, not a plane, on its inside, from the surface
};

/// The indices of one ray in the arrays.
struct RayPlaces {
  std::size_t org, dir;
  std::size_t start;  ///< for tmin, source and inside
  std::size_t tmax;
};

/// Calls visit(place, rays.org_x...), visit(place, rays.org_y...) and so on, once per array, with
/// the array's place. With several sets of rays, visit() gets the same array of each set.
template <class Visit, class... Rays>
BOULE_INLINE constexpr void each_array(const RayPlaces& places, const Visit& visit, Rays&... rays) {
  visit(places.org, rays.org_x...);
  visit(places.org, rays.org_y...);
  visit(places.org, rays.org_z...);
  visit(places.dir, rays.dir_x...);
  visit(places.dir, rays.dir_y...);
  visit(places.dir, rays.dir_z...);
  visit(places.start, rays.tmin...);
  visit(places.tmax, rays.tmax...);
  visit(places.start, rays.source...);
  visit(places.start, rays.inside...);
}

template <class T>
using Pointer = T*;

/// The coherence to promise for rays with this in common.
constexpr Coherence coherence_of(CommonPart common) {
  return common == CommonPart::origin      ? Coherence::common_origin
         : common == CommonPart::direction ? Coherence::common_direction
                                           : Coherence::none;
}

/// The numbers that all rays of a stream share. The arrays hold a shared number once, repeated for
/// the widest packet, and every ray reads it there, so the rays cannot differ in it. Kernels then
/// read less memory, and they need not compare the rays.
class SharedNumbers {
 public:
  SharedNumbers() = default;
  /// With a common origin or direction rays also share tmin, source and inside.
  explicit SharedNumbers(CommonPart common)
      : org_(common == CommonPart::origin ? one_packet : every_ray),
        dir_(common == CommonPart::direction ? one_packet : every_ray),
        start_(common != CommonPart::none ? one_packet : every_ray) {}

  [[nodiscard]] bool has_origin() const { return org_ == one_packet; }
  [[nodiscard]] bool has_direction() const { return dir_ == one_packet; }
  /// Whether they share tmin, source and inside.
  [[nodiscard]] bool has_start() const { return start_ == one_packet; }
  /// The places of the numbers of ray i. Those of the next rays in its packet follow.
  [[nodiscard]] BOULE_INLINE RayPlaces places(std::size_t i) const {
    return {i & org_, i & dir_, i & start_, i};
  }
  /// The lengths of the arrays for `size` rays.
  [[nodiscard]] RayPlaces lengths(std::size_t size) const {
    const auto length = [size](std::size_t mask) { return mask == one_packet ? max_width : size; };
    return {length(org_), length(dir_), length(start_), size};
  }

 private:
  static constexpr std::size_t one_packet = max_width - 1, every_ray = ~std::size_t{0};
  std::size_t org_ = every_ray, dir_ = every_ray, start_ = every_ray;  ///< masks of indices
};

/// Rays in memory as a structure of arrays: `size` rays. Every array is aligned to
/// stream_alignment. It is padded(size) long, or max_width where the rays share its number. A view:
/// owns nothing, checks nothing.
struct RayStream : RayArrays<Pointer> {
  std::size_t size;
  SharedNumbers shared;

  [[nodiscard]] BOULE_INLINE RayPlaces places(std::size_t i) const { return shared.places(i); }
};

/// `size` rays from ray `first` on, where `first` is a multiple of max_width. Precondition: the
/// stream has them.
inline RayStream part(const RayStream& rays, std::size_t first, std::size_t size) {
  RayStream some = rays;
  each_array(
      rays.places(first), [](std::size_t at, auto& array) { array += at; }, some);
  some.size = size;
  return some;
}

/// The ray at these places of a stream or of other RayArrays. Precondition: the places are valid.
template <class Rays>
BOULE_INLINE Ray get_ray(const Rays& rays, const RayPlaces& at) {
  Ray ray{{rays.org_x[at.org], rays.org_y[at.org], rays.org_z[at.org]},
          {rays.dir_x[at.dir], rays.dir_y[at.dir], rays.dir_z[at.dir]}};
  ray.tmin = double{rays.tmin[at.start]};
  ray.tmax = double{rays.tmax[at.tmax]};
  ray.source = rays.source[at.start];
  ray.inside = rays.inside[at.start] != 0;
  return ray;
}
BOULE_INLINE Ray get_ray(const RayStream& rays, std::size_t i) {
  return get_ray(rays, rays.places(i));
}

/// Nearest hits, one per ray: t in double, unrounded, and the primitive's id; inf and -1 for a
/// miss. For a sphere, `slot` is its slot in the geometry, for a capsule that among the capsules;
/// for other hits it is undefined. Arrays are as in RayStream.
struct HitStream {
  double* t;
  std::int32_t* id;
  std::uint32_t* slot;
  std::size_t size;
};

inline HitStream part(const HitStream& hits, std::size_t first, std::size_t size) {
  return {hits.t + first, hits.id + first, hits.slot + first, size};
}

/// Output: the chords of rays, ray after ray, for `capacity` of them. A ray is in the primitive
/// `id` from `enter` to `leave`, in units of t; a tangent has them equal. `enter` is -inf where the
/// ray leaves a sphere on its inside. A plane bounds the half-space behind it: the other end is
/// infinite. `slot`: as in HitStream. Arrays need no alignment or padding.
struct ChordStream {
  double* enter;
  double* leave;
  std::int32_t* id;
  std::uint32_t* slot;
  std::size_t capacity;
};

/// Samples of the image plane through which primary rays go, in raster coordinates: (0, 0) is the
/// top left corner, and pixel (i, j) has its centre at (i + 0.5, j + 0.5). Arrays are as in
/// RayStream. Arrays that a camera leaves unused may be null: lens_x and lens_y without has_lens(),
/// `weight` unless the camera `weighs`.
struct SampleStream {
  double* raster_x;
  double* raster_y;
  double* lens_x;  ///< with lens_y a point of the lens, each in 0 .. 1; (0.5, 0.5) is its centre
  double* lens_y;
  float* weight;  ///< output: the weight of the ray's radiance; 0: there is no ray
  std::size_t size;
};

/// The number of rays per call that makes any_hit fast in a scene of so many spheres. With more
/// rays to one light, neighbours are closer together and bundles of them visit fewer leaves. That
/// outweighs the larger use of the caches once the spheres exceed the caches as well. Set by trial;
/// to repeat it with other numbers here: bench_peers --scenes u100000,u1000000 --rays shadow
constexpr std::size_t fitting_stream_size(std::size_t spheres) {
  return spheres > 262144 ? 65536 : 16384;
}

}  // namespace boule
