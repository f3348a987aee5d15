#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/root_bounds.h"
#include "simd/kernel/tuning.h"

/// The results of packets and single rays so far: the nearest hit per lane, or whether a lane has
/// hit anything. A search offers spheres in two ways. consider() takes the float bounds of a sphere
/// and says whether double must decide; offer() takes the result of the double solver.
namespace boule::BOULE_KERNEL_ISA {

/// The nearest hit per lane. Most rays need only one double solve, at the end: as long as float is
/// certain which sphere is the nearest, that sphere stays `pending`, and settle() solves it.
struct ClosestHit {
  Wide t;        ///< of the nearest solved hit
  Bits id;       ///< id of the primitive of that hit
  Bits slot;     ///< its slot, if it is a sphere
  Bits pending;  ///< slot of a sphere that is certainly hit, and certainly nearer than t
  RealMask is_pending;
  Real nearest;  ///< lower bound of t |dir|: of the pending hit, otherwise of the solved one or of
                 ///< tmax
  Real reach;    ///< upper bound of the t |dir| at which a nearer hit is possible

  BOULE_INLINE explicit ClosestHit(const RayLanes& rays)
      : t(no_hit),
        id(no_primitive),
        slot(0),
        pending(0),
        is_pending(uniform(false)),
        nearest(rays.filter.live_to),
        reach(distance(rays.exact.tmax, rays)) {}

  /// t |dir|, rounded. The bounds it is compared with allow for that (filter_bounds.h).
  BOULE_INLINE static Real distance(const Wide& t, const RayLanes& rays) {
    return narrow(t * rays.filter.length);
  }

  /// Takes the float bounds of the sphere in `in_slot`. `low` is a lower bound of its hit; lanes in
  /// `out` miss it. Returns whether the double solver must decide. Float is enough if every lane is
  /// out, has a nearer sphere, or certainly has its nearest hit here. Adds those lanes to `out`.
  BOULE_INLINE bool consider(const RootBounds& roots, const Real& low, unsigned& out,
                             const Bits& in_slot, const FilterRays& rays) {
    const Real high = highest(roots, rays);
    const RealMask first = high < nearest;
    out |= bits(first | (reach < low));
    reach = select(high < reach, high, reach);
    nearest = select(first, low, nearest);
    pending = select(first, in_slot, pending);
    is_pending = is_pending | first;
    return out != all_lanes;
  }
  /// Whether a sphere with the lower bound `low` may still be the nearest in a lane outside `out`.
  BOULE_INLINE bool wants(const Real& low, unsigned out) const {
    return (bits(reach < low) | out) != all_lanes;
  }

  /// The largest t |dir| at which a hit still counts.
  [[nodiscard]] BOULE_INLINE Real limit() const { return reach; }

  /// `in_slot`: the slot of the primitive, if it is a sphere.
  BOULE_INLINE void offer(const Roots& roots, const Bits& primitive, const Bits& in_slot,
                          const RayLanes& rays) {
    const WideMask lower_id = widen(~(id <= primitive));
    const WideMask nearer = (roots.t < t) | ((roots.t == t) & lower_id);
    const WideMask better = roots.hit & nearer;
    if (any(better)) take(roots.t, primitive, in_slot, better, rays);
  }
  /// Solves the pending hits by one double solve, each lane against its own sphere.
  template <class Spheres>
  BOULE_INLINE void settle(const Spheres& spheres, const RayLanes& rays) {
    if (bits(is_pending) == 0) return;
    const SphereLanes each = gather_spheres(spheres, pending);
    const Roots roots = solve_robust(rays.exact, each);
    take(roots.t, each.id, pending, roots.hit & widen(is_pending), rays);
    is_pending = uniform(false);
  }
  static constexpr bool done() { return false; }
  /// The lanes among `lanes` whose search is still open.
  static constexpr unsigned open(unsigned lanes) { return lanes; }
  static constexpr bool ordered = true;  ///< visiting near children first saves work
  static constexpr std::size_t chunk = tuning::nearest_chunk;

 private:
  BOULE_INLINE void take(const Wide& new_t, const Bits& new_id, const Bits& new_slot,
                         const WideMask& lanes, const RayLanes& rays) {
    t = select(lanes, new_t, t);
    id = select(narrow(lanes), new_id, id);
    slot = select(narrow(lanes), new_slot, slot);
    const Real solved = distance(t, rays);
    reach = select(solved < reach, solved, reach);
    nearest = select(solved < rays.filter.live_to, solved, rays.filter.live_to);
  }
};

/// Whether each lane has a hit. With `one_ray` all lanes hold the same ray, and one hit is enough.
template <bool one_ray>
struct AnyHit {
  unsigned hit = 0;  ///< lanes as bits
  Real far;          ///< upper bound of the t |dir| that counts; below everything in lanes with a
                     ///< hit

  BOULE_INLINE explicit AnyHit(const RayLanes& rays)
      : far(ClosestHit::distance(rays.exact.tmax, rays)) {}

  BOULE_INLINE bool consider(const RootBounds& roots, const Real& low, unsigned out, const Bits&,
                             const FilterRays& rays) {
    const RealMask found = live(roots, rays);
    hit |= bits(found);
    far = select(found, Real(-std::numeric_limits<float>::max()), far);
    return wants(low, out);
  }
  BOULE_INLINE bool wants(const Real& low, unsigned out) const {
    return !done() && (bits(far < low) | out | hit) != all_lanes;
  }
  [[nodiscard]] BOULE_INLINE Real limit() const { return far; }

  BOULE_INLINE void offer(const Roots& roots, const Bits&, const Bits&, const RayLanes&) {
    hit |= bits(roots.hit);
  }
  template <class Spheres>
  static void settle(const Spheres&, const RayLanes&) {}
  [[nodiscard]] bool done() const { return one_ray ? hit != 0 : hit == all_lanes; }
  [[nodiscard]] unsigned open(unsigned lanes) const { return one_ray ? lanes : lanes & ~hit; }
  static constexpr bool ordered = false;
  static constexpr std::size_t chunk = tuning::any_chunk;
};

}  // namespace boule::BOULE_KERNEL_ISA
