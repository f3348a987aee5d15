#pragma once

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/capsule.h"
#include "simd/kernel/search/packet/traverse.h"

/// Packets and single rays against capsules: scanned ones first, then their tree, near children
/// first. Boxes and distances in float are filters; double decides about what passes.
namespace boule::BOULE_KERNEL_ISA {

/// Tests the capsules of a block, the first `size` slots, against the rays of `lanes`.
template <class Access, class Best>
BOULE_INLINE void meet_capsules(const RayLanes& rays, const CapsuleView& capsules,
                                std::size_t first_slot, std::size_t size, unsigned lanes,
                                Best& best) {
  const BlockCapsules<Access> block{capsules.blocks[first_slot / bvh_leaf_size],
                                    capsules.id + first_slot, first_slot};
  for (std::size_t step = 0; step < Access::steps(size) && !best.done(); ++step) {
    const CapsuleLanes capsule = block.get(step);
    const CapsuleBounds bounds = bound_capsule(rays.filter, capsule);
    unsigned out = bits(bounds.out);
    out |= Access::one_ray ? ~first_lanes(size - step * width) & all_lanes : ~lanes & all_lanes;
    if (best.wants(bounds.low, out)) best.meet(rays, capsule, block.slot(step), out);
  }
}

/// Searches all capsules.
template <class Access, class Best>
BOULE_INLINE void search_capsules(const RayLanes& rays, const CapsuleView& capsules, Best& best) {
  for (std::size_t slot = 0; slot < capsules.scanned && !best.done(); slot += bvh_leaf_size)
    meet_capsules<Access>(rays, capsules, slot, bvh_leaf_size, all_lanes, best);
  if (capsules.bvh.size == 0) return;
  with_walk<Access>(rays, best, capsules.bvh, [&](auto& walk) -> std::size_t {
    VisitStack stack;
    stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
    float limit = limit_of_all<Access>(best.limit());
    while (!stack.empty() && !best.done()) {
      const Visit visit = stack.pop();
      if (is_beyond(visit, limit)) continue;
      const unsigned lanes = best.open(visit.lanes);
      if (lanes == 0) continue;
      if (visit.leaf_size == 0) {
        walk.visit_children(capsules.bvh.nodes[visit.child], lanes, best.limit(), limit, stack);
      } else {
        const std::size_t slot = capsules.scanned + index_of(visit.child) * bvh_leaf_size;
        meet_capsules<Access>(rays, capsules, slot, visit.leaf_size, lanes, best);
        limit = limit_of_all<Access>(best.limit());
      }
    }
    return 0;
  });
}

}  // namespace boule::BOULE_KERNEL_ISA
