#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/primitive_access.h"

/// Brute force: every primitive against the rays. A hot float loop lists the steps that some lane
/// survives; the double solves run over that list, outside it.
namespace boule::BOULE_KERNEL_ISA {

/// The nearest hit so far, per lane.
struct ClosestHit {
  Wide t, id;
  Real reach;  ///< upper bound of live t |dir|

  BOULE_INLINE explicit ClosestHit(const RayLanes& rays)
      : t(no_hit), id(-1.0), reach(bound(rays.exact.tmax, rays)) {}

  BOULE_INLINE static Real bound(const Wide& t, const RayLanes& rays) {
    return narrow(t * rays.filter.length) * Real(static_cast<float>(1 + 8 * filter::u));
  }

  BOULE_INLINE void offer(const Roots& roots, const Wide& primitive, const RayLanes& rays) {
    const WideMask nearer = (roots.t < t) | ((roots.t == t) & (primitive < id));
    const WideMask better = roots.hit & nearer;
    if (!any(better)) return;
    t = select(better, roots.t, t);
    id = select(better, primitive, id);
    const Wide end = select(t < rays.exact.tmax, t, rays.exact.tmax);
    reach = bound(end, rays);
  }
  static constexpr bool done() { return false; }
  static constexpr std::size_t chunk = 256;
};

/// Whether anything is hit, per lane; `done` says what ends the search.
template <bool one_ray>
struct AnyHit {
  unsigned hit = 0;
  Real reach;

  BOULE_INLINE explicit AnyHit(const RayLanes& rays)
      : reach(ClosestHit::bound(rays.exact.tmax, rays)) {}

  BOULE_INLINE void offer(const Roots& roots, const Wide&, const RayLanes&) {
    hit |= bits(roots.hit);
  }
  [[nodiscard]] bool done() const { return one_ray ? hit != 0 : hit == all_lanes; }
  static constexpr std::size_t chunk = 64;
};

/// Steps that the float reject lets through.
template <std::size_t capacity>
struct Survivors {
  std::uint32_t offset[capacity + 4];  ///< from the chunk's first step
  std::size_t count = 0;
};

/// The hot loop: 4 steps a branch, so that the common case is one test of four masks.
template <class Access, bool origins_exact, std::size_t capacity>
BOULE_INLINE void list_survivors(const FilterRays& rays, const SphereView& spheres,
                                 std::size_t begin, std::size_t end,
                                 Survivors<capacity>& survivors) {
  const auto test = [&](std::size_t step) {
    return rejected<origins_exact>(rays, approach(rays, sphere_center<Access>(spheres, step)),
                                   Access::get(spheres.reject_threshold, step),
                                   Access::get(spheres.reject_radius, step));
  };
  const auto append = [&](std::size_t step, RealMask out) {
    survivors.offset[survivors.count] = static_cast<std::uint32_t>(step - begin);
    survivors.count += all(out) ? 0 : 1;
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

/// The solves of one surviving step, for the lanes that need them.
template <Solver solver, class Access, class Best>
BOULE_INLINE void solve_step(const RayLanes& rays, const SphereView& spheres, std::size_t step,
                             Best& best) {
  const SphereLanes sphere = get_sphere<Access>(spheres, step);
  const Approach near = approach(rays.filter, sphere.center);
  const RealMask out =
      rejected<false>(rays.filter, near, sphere.reject_threshold, sphere.reject_radius) |
      out_of_range(rays.filter, near, sphere.radius, best.reach);
  if (all(out)) return;
  if constexpr (solver == Solver::fast) {
    best.offer(solve_fast(rays, sphere), sphere.id, rays);
  } else {
    best.offer(solve_robust(rays.exact, sphere), sphere.id, rays);
  }
}

template <Solver solver, class Access, bool origins_exact, class Best>
BOULE_INLINE void scan_spheres(const RayLanes& rays, const SphereView& spheres, Best& best) {
  const std::size_t steps = Access::steps(spheres.size);
  for (std::size_t begin = 0; begin < steps && !best.done(); begin += Best::chunk) {
    const std::size_t end = steps - begin < Best::chunk ? steps : begin + Best::chunk;
    Survivors<Best::chunk> survivors;
    list_survivors<Access, origins_exact>(rays.filter, spheres, begin, end, survivors);
    for (std::size_t k = 0; k < survivors.count; ++k) {
      solve_step<solver, Access>(rays, spheres, begin + survivors.offset[k], best);
    }
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

/// Every primitive against these rays.
template <Solver solver, class Access, class Best>
BOULE_NOINLINE void scan(const RayLanes& rays, const GeometryView& geometry, Best& best) {
  if (rays.filter.origins_exact) {
    scan_spheres<solver, Access, true>(rays, geometry.spheres, best);
  } else {
    scan_spheres<solver, Access, false>(rays, geometry.spheres, best);
  }
  scan_planes<solver, Access>(rays, geometry.planes, best);
}

}  // namespace boule::BOULE_KERNEL_ISA
