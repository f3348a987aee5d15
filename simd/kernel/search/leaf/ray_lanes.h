#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/ray.h"
#include "core/math/vec.h"
#include "simd/abi/filter_bounds.h"
#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

/// Rays in lanes, for every search: W different rays (a packet), or one ray in every lane. A ray
/// exists twice: as ExactRays in double, for the solver that decides, and as FilterRays in float,
/// for the filters, which only reject certain misses (simd/abi/filter_bounds.h).
namespace boule::BOULE_KERNEL_ISA {

inline constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Rays for the exact solver, in double.
struct ExactRays {
  Vec3<Wide> org, dir;
  Wide a;           ///< dir.dir
  Wide inverse_a;   ///< 1 / a
  Wide tmin, tmax;  ///< valid hits: tmin < t <= tmax; tmax is at most FLT_MAX
  Bits source;      ///< id of the primitive that the ray leaves, or no_primitive
  WideMask inside;  ///< it leaves `source` on its inside
  bool has_source;  ///< some lane's ray leaves a primitive
};

/// Rays for the filters, in float. Distances are t |dir|: along the unit direction.
struct FilterRays {
  Vec3<Real> org;           ///< rounded to float
  Vec3<Real> h;             ///< dir / |dir| (1 + slack u / 2), rounded; NaN: rejects nothing
  Vec3<Real> unit;          ///< dir / |dir|, rounded
  Real origin_error;        ///< bound of |org - exact origin|, plus filter::floor
  bool origins_exact;       ///< every origin is a float
  Wide length;              ///< |dir|
  Real inverse_length;      ///< 1 / |dir|
  Real live_from, live_to;  ///< the interval of t |dir| of valid hits, rounded
  Real dead_below;          ///< lower bound of t |dir| of valid hits: 0, or -inf where tmin < 0
};

/// Lanes that float can judge, and that have no hits behind their origins. (In other lanes the
/// direction is NaN.)
BOULE_INLINE RealMask is_judged(const FilterRays& rays) {
  return (rays.unit.x <= rays.unit.x) & (Real(0.0F) <= rays.dead_below);
}

struct RayLanes {
  ExactRays exact;
  FilterRays filter;
  unsigned inside;  ///< the lanes of exact.inside, as bits
};

template <class T>
BOULE_INLINE T sum_abs(const Vec3<T>& v) {
  return abs(v.x) + abs(v.y) + abs(v.z);
}
BOULE_INLINE Vec3<Wide> widen(const Vec3<Real>& v) { return {widen(v.x), widen(v.y), widen(v.z)}; }
BOULE_INLINE Vec3<Real> narrow(const Vec3<Wide>& v) {
  return {narrow(v.x), narrow(v.y), narrow(v.z)};
}

/// a.b for filters, fused where the ISA can.
BOULE_INLINE Real filter_dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return filter_fma(a.z, b.z, filter_fma(a.y, b.y, a.x * b.x));
}

BOULE_INLINE void make_filter(const ExactRays& rays, FilterRays& out) {
  out.org = narrow(rays.org);
  const Wide error = sum_abs(rays.org - widen(out.org));
  out.origins_exact = !any(Wide(0.0) < error);
  out.origin_error = narrow(error * Wide(1 + 2 * filter::slack * filter::u) + Wide(filter::floor));
  out.length = sqrt(rays.a);
  const Wide inverse_length = out.length * rays.inverse_a;
  out.inverse_length = narrow(inverse_length);
  // NaN for dir 0 and for all numbers that are not finite.
  out.unit = narrow(rays.dir * inverse_length);
  out.h = narrow(rays.dir * (inverse_length * Wide(1 + filter::slack / 2 * filter::u)));
  const Real limit(filter::limit);
  const RealMask small =
      (abs(out.org.x) < limit) & (abs(out.org.y) < limit) & (abs(out.org.z) < limit);
  const Real nan(std::numeric_limits<float>::quiet_NaN());
  out.h.x = select(small, out.h.x, nan);
  out.unit.x = select(small, out.unit.x, nan);
  const Real largest(std::numeric_limits<float>::max());
  const Real from = narrow(rays.tmin * out.length), far = narrow(rays.tmax * out.length);
  const Real to = select(largest < far, largest, far);  // NaN stays: the interval is then empty
  const Real zero(0.0F);
  out.live_from = from;
  out.live_to = to;
  out.dead_below = select(from < zero, Real(-std::numeric_limits<float>::infinity()), zero);
}

/// Computes the members that follow from dir, tmax and source.
BOULE_INLINE void finish(ExactRays& rays) {
  rays.a = dot(rays.dir, rays.dir);
  rays.inverse_a = Wide(1.0) / rays.a;
  const Wide largest(static_cast<double>(std::numeric_limits<float>::max()));
  rays.tmax = select(largest < rays.tmax, largest, rays.tmax);
  rays.has_source = !all(rays.source == Bits(no_primitive));
}

/// The numbers of rays first .. first + W - 1; `first` is a multiple of W.
BOULE_INLINE Vec3<Wide> load_origins(const RayStream& s, std::size_t first) {
  const std::size_t at = s.places(first).org;
  return {load(s.org_x + at), load(s.org_y + at), load(s.org_z + at)};
}
BOULE_INLINE Vec3<Real> load_directions(const RayStream& s, std::size_t first) {
  const std::size_t at = s.places(first).dir;
  return {load(s.dir_x + at), load(s.dir_y + at), load(s.dir_z + at)};
}

/// Loads these rays.
BOULE_INLINE void load_exact(const RayStream& s, std::size_t first, ExactRays& r) {
  const std::size_t start = s.places(first).start;
  r.org = load_origins(s, first);
  r.dir = widen(load_directions(s, first));
  r.tmin = widen(load(s.tmin + start));
  r.tmax = widen(load(s.tmax + first));
  r.source = load_integers(s.source + start);
  r.inside = load_set(s.inside + start);
  finish(r);
}
BOULE_INLINE void load_packet(const RayStream& s, std::size_t first, RayLanes& rays) {
  load_exact(s, first, rays.exact);
  make_filter(rays.exact, rays.filter);
  rays.inside = bits(rays.exact.inside);
}

/// Loads a ray into every lane.
BOULE_INLINE void load_single(const Ray& ray, RayLanes& rays) {
  ExactRays& r = rays.exact;
  r.org = {Wide(ray.org.x), Wide(ray.org.y), Wide(ray.org.z)};
  r.dir = widen(Vec3<Real>{Real(ray.dir.x), Real(ray.dir.y), Real(ray.dir.z)});
  r.tmin = Wide(ray.tmin);
  r.tmax = Wide(ray.tmax);
  r.source = Bits(ray.source);
  r.inside = widen(uniform(ray.inside));
  finish(r);
  make_filter(r, rays.filter);
  rays.inside = bits(r.inside);
}
BOULE_INLINE void load_single(const RayStream& s, std::size_t index, RayLanes& rays) {
  load_single(get_ray(s, index), rays);
}

/// The t of a hit per lane, and the lanes that have one.
struct Roots {
  Wide t;
  WideMask hit;
};

BOULE_INLINE WideMask in_range(const Wide& t, const ExactRays& rays) {
  return (rays.tmin < t) & (t <= rays.tmax);
}

/// The first of two ordered roots that is in range.
BOULE_INLINE Roots first_in_range(const Wide& first, const Wide& second, const ExactRays& rays) {
  const WideMask first_ok = in_range(first, rays);
  return {select(first_ok, first, second), first_ok | in_range(second, rays)};
}

}  // namespace boule::BOULE_KERNEL_ISA
