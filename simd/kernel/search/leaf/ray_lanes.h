#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/number.h"
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

/// One ray by itself has numbers in place of lanes, by the same formulas: core/math/number.h.
using boule::abs;
using boule::any;
using boule::copysign;
using boule::narrow;
using boule::select;
using boule::sqrt;
using boule::widen;
BOULE_INLINE float abs(float x) { return __builtin_fabsf(x); }
BOULE_INLINE bool all(bool mask) { return mask; }

/// Rays for the exact solver, in double.
template <class W, class Id, class Mask>
struct ExactOf {
  Vec3<W> org, dir;
  W a;              ///< dir.dir
  W inverse_a;      ///< 1 / a
  W tmin, tmax;     ///< valid hits: tmin < t <= tmax; tmax is at most FLT_MAX
  Id source;        ///< id of the primitive that the ray leaves, or no_primitive
  Mask inside;      ///< it leaves `source` on its inside
  bool has_source;  ///< some lane's ray leaves a primitive
};
using ExactRays = ExactOf<Wide, Bits, WideMask>;
using ExactRay = ExactOf<double, std::int32_t, bool>;

/// Rays for the filters, in float. Distances are t |dir|: along the unit direction.
template <class R, class W>
struct FilterOf {
  Vec3<R> org;           ///< rounded to float
  Vec3<R> h;             ///< dir / |dir| (1 + slack u / 2), rounded; NaN: rejects nothing
  Vec3<R> unit;          ///< dir / |dir|, rounded
  R origin_error;        ///< bound of |org - exact origin|, plus filter::floor
  bool origins_exact;    ///< every origin is a float
  W length;              ///< |dir|
  R inverse_length;      ///< 1 / |dir|
  R live_from, live_to;  ///< the interval of t |dir| of valid hits, rounded
  R dead_below;          ///< lower bound of t |dir| of valid hits: 0, or -inf where tmin < 0
};
using FilterRays = FilterOf<Real, Wide>;
using FilterRay = FilterOf<float, double>;

/// Lanes that float can judge, and that have no hits behind their origins. (In other lanes the
/// direction is NaN.)
template <class R, class W>
BOULE_INLINE auto is_judged(const FilterOf<R, W>& rays) {
  return (rays.unit.x <= rays.unit.x) & (R(0.0F) <= rays.dead_below);
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
BOULE_INLINE Vec3d widen(const Vec3f& v) { return vec_cast<double>(v); }

/// a.b for filters, fused where the ISA can.
BOULE_INLINE Real filter_dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return filter_fma(a.z, b.z, filter_fma(a.y, b.y, a.x * b.x));
}

template <class Exact, class R, class W>
BOULE_INLINE void make_filter(const Exact& rays, FilterOf<R, W>& out) {
  out.org = narrow(rays.org);
  const W error = sum_abs(rays.org - widen(out.org));
  out.origins_exact = !any(W(0.0) < error);
  out.origin_error = narrow(error * W(1 + 2 * filter::slack * filter::u) + W(filter::floor));
  out.length = sqrt(rays.a);
  const W inverse_length = out.length * rays.inverse_a;
  out.inverse_length = narrow(inverse_length);
  // NaN for dir 0 and for all numbers that are not finite.
  out.unit = narrow(rays.dir * inverse_length);
  out.h = narrow(rays.dir * (inverse_length * W(1 + filter::slack / 2 * filter::u)));
  const R limit(filter::limit);
  const auto small = (abs(out.org.x) < limit) & (abs(out.org.y) < limit) & (abs(out.org.z) < limit);
  const R nan(std::numeric_limits<float>::quiet_NaN());
  out.h.x = select(small, out.h.x, nan);
  out.unit.x = select(small, out.unit.x, nan);
  const R largest(std::numeric_limits<float>::max());
  const R from = narrow(rays.tmin * out.length), far = narrow(rays.tmax * out.length);
  const R to = select(largest < far, largest, far);  // NaN stays: the interval is then empty
  const R zero(0.0F);
  out.live_from = from;
  out.live_to = to;
  out.dead_below = select(from < zero, R(-std::numeric_limits<float>::infinity()), zero);
}

/// Computes the members that follow from dir, tmax and source.
template <class W, class Id, class Mask>
BOULE_INLINE void finish(ExactOf<W, Id, Mask>& rays) {
  rays.a = dot(rays.dir, rays.dir);
  rays.inverse_a = W(1.0) / rays.a;
  const W largest(static_cast<double>(std::numeric_limits<float>::max()));
  rays.tmax = select(largest < rays.tmax, largest, rays.tmax);
  rays.has_source = !all(rays.source == Id(no_primitive));
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
