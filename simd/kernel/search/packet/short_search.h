#pragma once

#include <cstddef>

#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/packet/short_walk.h"
#include "simd/kernel/search/packet/traverse.h"
#include "simd/kernel/search/packet/tree_blocks.h"
#include "simd/kernel/search/packet/visit_stack.h"
#include "simd/kernel/tuning.h"

/// Two packets of short any-hit rays that share their traversal of the tree. Chosen where
/// neighbouring packets have about the same reach, as in ambient occlusion: one test of a visit
/// then serves twice as many rays.
namespace boule::BOULE_KERNEL_ISA {

struct TwoPackets {
  RayLanes rays[2];  ///< of either one
};

/// The rays of two packets that have no hit yet: those of the first, then those of the second.
BOULE_INLINE unsigned open_rays(const AnyHit<false> (&best)[2]) {
  return best[0].open(all_lanes) | best[1].open(all_lanes) << width;
}

/// Searches the tree for both. Returns the sum of the nodes and leaves that each has visited.
BOULE_INLINE std::size_t traverse_together(const TwoPackets& packets, Solver solver,
                                           ShortWalk<2>& walk, const GeometryView& geometry,
                                           AnyHit<false> (&best)[2]) {
  using Walk = ShortWalk<2>;
  const WholeTree tree(geometry);
  std::size_t visits = 0;
  VisitStack stack;
  stack.push_if(true, {-static_cast<float>(no_hit), 0, 0, open_rays(best)});
  while (!stack.empty()) {
    const Visit visit = stack.pop();
    const unsigned lanes = visit.lanes & open_rays(best);
    if (lanes == 0) continue;
    visits += (Walk::of_packet(lanes, 0) != 0 ? 1 : 0) + (Walk::of_packet(lanes, 1) != 0 ? 1 : 0);
    if (visit.leaf_size == 0) {
      const Real limits[2] = {best[0].limit(), best[1].limit()};
      const int before = stack.count();
      walk.visit_children(tree.node(visit.child), lanes, limits, stack);
      for (int at = stack.count() - 1; at >= before; --at) tree.fetch(stack.child(at));
      continue;
    }
    const LeafSpheres<OneForAll> leaf(tree.leaf(visit.child), visit.leaf_size);
    const unsigned in = walk.reach(leaf, lanes);
    if (in == 0) continue;
    for (int p = 0; p < 2; ++p) {
      const unsigned of_packet = Walk::of_packet(lanes, p);
      if (of_packet == 0) continue;
      Survivors<bvh_leaf_size> survivors;
      walk.list_survivors(p, leaf, of_packet, in, best[p].limit(), survivors);
      if (survivors.count == 0) continue;
      meet_survivors(packets.rays[p], solver, geometry.spheres, leaf, 0, survivors, best[p]);
    }
  }
  return visits;
}

/// Whether both are short, go all ways, and have about the same reach. Grows `reach`, of the first,
/// to hold both.
BOULE_INLINE bool reach_the_same(const TwoPackets& packets, const AnyHit<false> (&best)[2],
                                 float extent, ReachBox& reach) {
  if (!reach.is_short()) return false;
  const ReachBox second(packets.rays[1].filter, best[1].limit(), extent);
  return second.is_short() && !forms_beam(packets.rays[0].filter) &&
         !forms_beam(packets.rays[1].filter) && reach.grow(second, tuning::most_shared_growth);
}

/// Searches all primitives for two packets. Returns the sum of the nodes and leaves that each has
/// visited.
BOULE_NOINLINE inline std::size_t search_two(const TwoPackets& packets, Solver solver,
                                             const GeometryView& geometry,
                                             AnyHit<false> (&best)[2]) {
  if (geometry.bvh.size != 0) {
    ReachBox reach(packets.rays[0].filter, best[0].limit(), geometry.bvh.extent);
    if (reach_the_same(packets, best, geometry.bvh.extent, reach)) {
      for (int p = 0; p < 2; ++p)
        scan_spheres<OneForAll>(packets.rays[p], solver, geometry.spheres, best[p]);
      ShortWalk<2> walk(packets.rays, reach, untested_of(geometry.bvh), geometry.bvh.extent);
      const std::size_t visits = traverse_together(packets, solver, walk, geometry, best);
      for (int p = 0; p < 2; ++p)
        scan_planes<OneForAll>(packets.rays[p], solver, geometry.planes, best[p]);
      return visits;
    }
  }
  return search<OneForAll>(packets.rays[0], solver, geometry, best[0]) +
         search<OneForAll>(packets.rays[1], solver, geometry, best[1]);
}

}  // namespace boule::BOULE_KERNEL_ISA
