#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/primitive_access.h"
#include "simd/kernel/search/root_bounds.h"

/// A run of primitives against the rays. A hot float loop lists the steps that some lane survives;
/// the double solves run over that list, outside it.
namespace boule::BOULE_KERNEL_ISA {

/// The nearest hit so far, per lane. Most lanes need one double solve at all: while float can tell
/// for certain which sphere is the nearest, that sphere is only `pending`; settle() solves it.
struct ClosestHit {
  Wide t, id;    ///< the nearest hit that is solved
  Real pending;  ///< bits of the slot of a sphere that is hit for certain, nearer for certain
  RealMask is_pending;
  Real
      nearest;  ///< lower bound of t |dir| of the pending hit, else the solved one's, or tmax |dir|
  Real reach;  ///< upper bound of live t |dir|: of the hit so far, or of one that is still to solve

  BOULE_INLINE explicit ClosestHit(const RayLanes& rays)
      : t(no_hit),
        id(-1.0),
        pending(0.0F),
        is_pending(Real(0.0F) < Real(0.0F)),
        nearest(rays.filter.live_to),
        reach(distance(rays.exact.tmax, rays)) {}

  /// t |dir|, rounded: the bounds that it is compared with pay for that (filter_bounds.h).
  BOULE_INLINE static Real distance(const Wide& t, const RayLanes& rays) {
    return narrow(t * rays.filter.length);
  }

  /// Takes what float knows of a sphere, whose roots begin at `low` in lanes not `out`. False if
  /// that is all it takes: only where float cannot tell which hit is nearer is it left to solve.
  BOULE_INLINE bool consider(const RootBounds& roots, const Real& low, unsigned& out,
                             const Real& slot, const FilterRays& rays) {
    const Real high = highest(roots, rays);
    const RealMask first = high < nearest;
    out |= bits(first | (reach < low));
    reach = select(high < reach, high, reach);
    nearest = select(first, low, nearest);
    pending = select(first, slot, pending);
    is_pending = is_pending | first;
    return out != all_lanes;
  }
  /// Whether a sphere whose roots begin at `low` could still be the nearest in a lane not `out`.
  BOULE_INLINE bool wants(const Real& low, unsigned out) const {
    return (bits(reach < low) | out) != all_lanes;
  }

  /// Nothing beyond this t |dir| is of interest.
  [[nodiscard]] BOULE_INLINE Real limit() const { return reach; }

  BOULE_INLINE void offer(const Roots& roots, const Wide& primitive, const RayLanes& rays) {
    const WideMask nearer = (roots.t < t) | ((roots.t == t) & (primitive < id));
    const WideMask better = roots.hit & nearer;
    if (any(better)) take(roots.t, primitive, better, rays);
  }
  /// Solves the pending hits: one double solve, each lane against its own sphere.
  BOULE_INLINE void settle(const SphereView& spheres, const RayLanes& rays) {
    if (bits(is_pending) == 0) return;
    const SphereLanes each = gather_spheres(spheres, pending);
    const Roots roots = solve_robust(rays.exact, each);
    take(roots.t, each.id, roots.hit & widen(is_pending), rays);
    is_pending = nearest < nearest;
  }
  static constexpr bool done() { return false; }
  static constexpr bool ordered = true;  ///< what is nearer had better come first
  static constexpr std::size_t chunk = 1024;

 private:
  BOULE_INLINE void take(const Wide& new_t, const Wide& new_id, const WideMask& lanes,
                         const RayLanes& rays) {
    t = select(lanes, new_t, t);
    id = select(lanes, new_id, id);
    const Real solved = distance(t, rays);
    reach = select(solved < reach, solved, reach);
    nearest = select(solved < rays.filter.live_to, solved, rays.filter.live_to);
  }
};

/// Whether anything is hit, per lane; `one_ray`: all lanes are the same ray, one hit is enough.
template <bool one_ray>
struct AnyHit {
  unsigned hit = 0;
  Real far;  ///< upper bound of live t |dir| that is still of interest

  BOULE_INLINE explicit AnyHit(const RayLanes& rays)
      : far(ClosestHit::distance(rays.exact.tmax, rays)) {}

  BOULE_INLINE bool consider(const RootBounds& roots, const Real& low, unsigned out, const Real&,
                             const FilterRays& rays) {
    const RealMask found = live(roots, rays);
    hit |= bits(found);
    far = select(found, Real(-std::numeric_limits<float>::max()), far);
    return wants(low, out);
  }
  BOULE_INLINE bool wants(const Real&, unsigned out) const {
    return !done() && (out | hit) != all_lanes;
  }
  [[nodiscard]] BOULE_INLINE Real limit() const { return far; }

  BOULE_INLINE void offer(const Roots& roots, const Wide&, const RayLanes&) {
    hit |= bits(roots.hit);
  }
  static void settle(const SphereView&, const RayLanes&) {}
  [[nodiscard]] bool done() const { return one_ray ? hit != 0 : hit == all_lanes; }
  static constexpr bool ordered = false;
  static constexpr std::size_t chunk = 64;
};

/// Steps that the float reject lets through.
template <std::size_t capacity>
struct Survivors {
  std::uint32_t offset[capacity + 4];  ///< from the chunk's first step
  std::size_t count = 0;

  BOULE_INLINE void append(std::uint32_t step, RealMask out) {
    offset[count] = step;
    count += all(out) ? 0 : 1;
  }
};

/// The hot loop: 4 steps a branch, so that the common case is one test of four masks.
template <bool origins_exact, class Spheres, std::size_t capacity>
BOULE_INLINE void list_survivors(const FilterRays& rays, const Spheres& spheres, std::size_t begin,
                                 std::size_t end, Survivors<capacity>& survivors) {
  const auto test = [&](std::size_t step) {
    return spheres.template out<origins_exact>(rays, step);
  };
  const auto append = [&](std::size_t step, RealMask out) {
    survivors.append(static_cast<std::uint32_t>(step - begin), out);
  };
  std::size_t step = begin;
  for (; step + 4 <= end; step += 4) {
    const RealMask out0 = test(step), out1 = test(step + 1);
    const RealMask out2 = test(step + 2), out3 = test(step + 3);
    if (all(out0 & out1 & out2 & out3)) continue;
    append(step, out0);
    append(step + 1, out1);
    append(step + 2, out2);
    append(step + 3, out3);
  }
  for (; step < end; ++step) append(step, test(step));
}

/// Survivors that only the double solve can decide.
template <std::size_t capacity>
struct Candidates {
  alignas(64) float low[capacity][width];  ///< lower bounds of their roots
  std::uint32_t offset[capacity];
  unsigned out[capacity];  ///< lanes that need no solve
  std::size_t count = 0;

  BOULE_INLINE void append(std::uint32_t step_offset, const Real& lower, unsigned dead_lanes) {
    store(low[count], lower);
    out[count] = dead_lanes;
    offset[count++] = step_offset;
  }
};

/// Everything that float can decide about the survivors; what it cannot is left to the solver.
template <class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void list_candidates(const RayLanes& rays, const Spheres& spheres, std::size_t begin,
                                  const Survivors<capacity>& survivors,
                                  Candidates<capacity>& candidates, Best& best) {
  for (std::size_t k = 0; k < survivors.count; ++k) {
    const std::size_t step = begin + survivors.offset[k];
    const RealMask own = spheres.own(rays, step);  // rays that leave this very sphere
    const unsigned leaving = bits(own);
    if ((leaving & rays.inside) != 0) {  // only the solver knows where it is met again
      candidates.append(survivors.offset[k], Real(-static_cast<float>(no_hit)), 0);
      continue;
    }
    if (!best.wants(before_roots(rays.filter, spheres.center(step), spheres.radius(step)), 0))
      continue;
    RootBounds roots =
        bound_roots(find_approach(rays.filter, spheres.center(step), spheres.radius(step)));
    Real low = lowest(roots, rays.filter);
    // From the outside it is never met again.
    roots.certain = roots.certain & ~own;
    low = select(own, Real(static_cast<float>(no_hit)), low);
    unsigned out = bits(dead(roots, rays.filter)) | leaving;
    if (best.consider(roots, low, out, spheres.slot(step), rays.filter)) {
      candidates.append(survivors.offset[k], low, out);
    }
  }
}

/// Solver robust on survivors: first everything that float can decide, then the double solves that
/// are left.
template <class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void solve_survivors(const RayLanes& rays, const SphereView& all,
                                  const Spheres& spheres, std::size_t begin,
                                  const Survivors<capacity>& survivors, Best& best) {
  Candidates<capacity> candidates;
  list_candidates(rays, spheres, begin, survivors, candidates, best);
  for (std::size_t k = 0; k < candidates.count; ++k) {
    if (!best.wants(load(candidates.low[k]), candidates.out[k])) continue;
    best.settle(all, rays);
    const SphereLanes sphere = get_sphere(spheres, begin + candidates.offset[k]);
    best.offer(solve_robust(rays.exact, sphere), sphere.id, rays);
  }
}

/// What is left of the spheres from step `begin` on; `all` of which they are a part.
template <Solver solver, class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void meet_survivors(const RayLanes& rays, const SphereView& all,
                                 const Spheres& spheres, std::size_t begin,
                                 const Survivors<capacity>& survivors, Best& best) {
  if constexpr (solver == Solver::robust) {
    solve_survivors(rays, all, spheres, begin, survivors, best);
  } else {
    for (std::size_t k = 0; k < survivors.count; ++k) {
      const SphereLanes sphere = get_sphere(spheres, begin + survivors.offset[k]);
      best.offer(solve_fast(rays, sphere), sphere.id, rays);
    }
  }
}

/// The spheres that are in no leaf.
template <Solver solver, class Access, bool origins_exact, class Best>
BOULE_INLINE void scan_spheres(const RayLanes& rays, const SphereView& spheres, Best& best) {
  const std::size_t steps = Access::steps(spheres.scanned);
  for (std::size_t begin = 0; begin < steps && !best.done(); begin += Best::chunk) {
    const std::size_t end = steps - begin < Best::chunk ? steps : begin + Best::chunk;
    const ScannedSpheres<Access> scanned{spheres};
    Survivors<Best::chunk> survivors;
    list_survivors<origins_exact>(rays.filter, scanned, begin, end, survivors);
    meet_survivors<solver>(rays, spheres, scanned, begin, survivors, best);
  }
}

template <Solver solver, class Access, class Best>
BOULE_INLINE void scan_planes(const RayLanes& rays, const PlaneView& planes, Best& best) {
  const std::size_t steps = Access::steps(planes.size);
  for (std::size_t step = 0; step < steps && !best.done(); ++step) {
    const PlaneLanes plane = get_plane<Access>(planes, step);
    if constexpr (solver == Solver::fast) {
      best.offer(solve_fast(rays, plane), plane.id, rays);
    } else {
      best.offer(solve_robust(rays.exact, plane), plane.id, rays);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
