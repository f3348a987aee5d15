#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/leaf/best_hit.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/root_bounds.h"

/// Scans: rays against one primitive after the other. Chosen for the spheres of every leaf, for the
/// spheres outside the leaves (all of them in small scenes), and for planes. A hot loop in float
/// lists the steps that the reject lets through in some lane. The undecided ones are solved in
/// double, outside that loop: inside it, the double code would take its registers, at a cost of 15
/// % of the speed. The hits are exact, whatever the order of the steps.
namespace boule::BOULE_KERNEL_ISA {

/// Steps that the reject lets through.
template <std::size_t capacity>
struct Survivors {
  std::uint32_t offset[capacity + 4];  ///< from the chunk's first step
  std::uint32_t out[capacity + 4];     ///< lanes that the reject turned away, as bits
  std::size_t count = 0;

  BOULE_INLINE void append(std::uint32_t step, unsigned turned_away) {
    offset[count] = step;
    out[count] = turned_away;
    count += turned_away == all_lanes ? 0 : 1;
  }
};

/// The hot loop. It takes four steps per branch, so that the common case, without survivors, costs
/// one test of four masks: 15 to 20 % faster than a branch per step. test(step): the lanes that
/// certainly miss.
template <class Test, std::size_t capacity>
BOULE_INLINE void list_survivors(const Test& test, std::size_t begin, std::size_t end,
                                 Survivors<capacity>& survivors) {
  const auto append = [&](std::size_t step, RealMask out) {
    survivors.append(static_cast<std::uint32_t>(step - begin), bits(out));
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

/// Survivors that only the double solver can decide.
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

/// Lets float decide about the survivors as far as it can, and lists the others.
template <class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void list_candidates(const RayLanes& rays, const Spheres& spheres, std::size_t begin,
                                  const Survivors<capacity>& survivors,
                                  Candidates<capacity>& candidates, Best& best) {
  for (std::size_t k = 0; k < survivors.count; ++k) {
    const std::size_t step = begin + survivors.offset[k];
    const RealMask own = spheres.own(rays, step);  // rays that leave this very sphere
    const unsigned leaving = bits(own);
    unsigned out = survivors.out[k] | leaving;
    if ((leaving & rays.inside) != 0) {  // only the solver can find where they hit it again
      candidates.append(survivors.offset[k], Real(-static_cast<float>(no_hit)), 0);
      continue;
    }
    if (out == all_lanes) continue;
    if (!best.wants(before_roots(rays.filter, spheres.center(step), spheres.radius(step)), out))
      continue;
    RootBounds roots =
        bound_roots(find_approach(rays.filter, spheres.center(step), spheres.radius(step)));
    Real low = lowest(roots, rays.filter);
    // Rays that leave a sphere on its outside never hit it again.
    roots.certain = roots.certain & ~own;
    low = select(own, Real(static_cast<float>(no_hit)), low);
    out |= bits(dead(roots, rays.filter));
    if (best.consider(roots, low, out, spheres.slot(step), rays.filter)) {
      candidates.append(survivors.offset[k], low, out);
    }
  }
}

/// Solver robust on survivors: first the decisions by float, then the remaining double solves.
template <class All, class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void solve_survivors(const RayLanes& rays, const All& all, const Spheres& spheres,
                                  std::size_t begin, const Survivors<capacity>& survivors,
                                  Best& best) {
  Candidates<capacity> candidates;
  list_candidates(rays, spheres, begin, survivors, candidates, best);
  for (std::size_t k = 0; k < candidates.count; ++k) {
    if (!best.wants(load(candidates.low[k]), candidates.out[k])) continue;
    best.settle(all, rays);
    const std::size_t step = begin + candidates.offset[k];
    const SphereLanes sphere = get_sphere(spheres, step);
    best.offer(solve_robust(rays.exact, sphere), sphere.id, spheres.slot(step), rays);
  }
}

/// Solver fast on survivors.
template <class Spheres, class Best, std::size_t capacity>
BOULE_NOINLINE void solve_survivors_fast(const RayLanes& rays, const Spheres& spheres,
                                         std::size_t begin, const Survivors<capacity>& survivors,
                                         Best& best) {
  for (std::size_t k = 0; k < survivors.count; ++k) {
    const std::size_t step = begin + survivors.offset[k];
    const SphereLanes sphere = get_sphere(spheres, step);
    best.offer(solve_fast(rays, sphere), sphere.id, spheres.slot(step), rays);
  }
}

/// Tests the survivors among `spheres`, listed from step `begin` on, by either solver. `all`: the
/// spheres of all slots.
template <class All, class Spheres, class Best, std::size_t capacity>
BOULE_INLINE void meet_survivors(const RayLanes& rays, Solver solver, const All& all,
                                 const Spheres& spheres, std::size_t begin,
                                 const Survivors<capacity>& survivors, Best& best) {
  if (solver == Solver::fast) {
    solve_survivors_fast(rays, spheres, begin, survivors, best);
  } else {
    solve_survivors(rays, all, spheres, begin, survivors, best);
  }
}

/// The number of spheres outside the leaves. With a tree their slots are whole blocks, of which a
/// ground sphere, say, fills one slot.
BOULE_INLINE std::size_t count_scanned(const SphereView& spheres) {
  std::size_t size = spheres.scanned;
  while (size > 4 && spheres.id[size - 4] < 0) size -= 4;
  while (size > 0 && spheres.id[size - 1] < 0) --size;
  return size;
}

/// Scans the spheres outside the leaves.
template <class Access, class Best>
BOULE_INLINE void scan_spheres(const RayLanes& rays, Solver solver, const SphereView& spheres,
                               Best& best) {
  const std::size_t steps = Access::steps(count_scanned(spheres));
  for (std::size_t begin = 0; begin < steps && !best.done(); begin += Best::chunk) {
    const std::size_t end = steps - begin < Best::chunk ? steps : begin + Best::chunk;
    const ScannedSpheres<Access> scanned{spheres};
    Survivors<Best::chunk> survivors;
    if (rays.filter.origins_exact) {
      const auto out = [&](std::size_t step) { return scanned.out_exact(rays.filter, step); };
      list_survivors(out, begin, end, survivors);
    } else {
      const auto out = [&](std::size_t step) { return scanned.out(rays.filter, step); };
      list_survivors(out, begin, end, survivors);
    }
    meet_survivors(rays, solver, spheres, scanned, begin, survivors, best);
  }
}

/// Scans the planes.
template <class Access, class Best>
BOULE_INLINE void scan_planes(const RayLanes& rays, Solver solver, const PlaneView& planes,
                              Best& best) {
  const std::size_t steps = Access::steps(planes.size);
  for (std::size_t step = 0; step < steps && !best.done(); ++step) {
    const PlaneLanes plane = get_plane<Access>(planes, step);
    if (solver == Solver::fast) {
      best.offer(solve_fast(rays, plane), plane.id, Bits(0), rays);
    } else {
      best.offer(solve_robust(rays.exact, plane), plane.id, Bits(0), rays);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
