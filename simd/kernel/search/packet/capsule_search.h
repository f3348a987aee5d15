#pragma once

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/capsule.h"
#include "simd/kernel/search/packet/traverse.h"

/// Packets and single rays against capsules: scanned ones first, then their tree, near children
/// first. Boxes and distances in float are filters; double decides about what passes.
namespace boule::BOULE_KERNEL_ISA {

/// Tests one step of a block's capsules, against the rays outside `out`.
template <class Access, class Best>
BOULE_INLINE void meet_step(const RayLanes& rays, const BlockCapsules<Access>& block,
                            std::size_t step, unsigned out, Best& best) {
  const CapsuleLanes capsule = block.get(step);
  const CapsuleBounds bounds = bound_capsule(rays.filter, capsule);
  out |= bits(bounds.out);
  if (best.wants(bounds.low, out)) best.consider(rays, capsule, bounds, block.slot(step), out);
}

/// Tests the capsule in a slot, against the rays outside `out`.
template <class Best>
BOULE_INLINE void meet_one(const RayLanes& rays, const CapsuleView& capsules, std::uint32_t slot,
                           unsigned out, Best& best) {
  const std::size_t k = slot % bvh_leaf_size, first_slot = slot - k;
  const BlockCapsules<OneForAll> block{capsules.blocks[first_slot / bvh_leaf_size],
                                       capsules.id + first_slot, first_slot};
  meet_step(rays, block, k, out, best);
}

/// Tests the first `size` capsules of a block.
template <class Access, class Best>
BOULE_INLINE void meet_block(const RayLanes& rays, const CapsuleView& capsules,
                             std::size_t first_slot, std::size_t size, Best& best) {
  const BlockCapsules<Access> block{capsules.blocks[first_slot / bvh_leaf_size],
                                    capsules.id + first_slot, first_slot};
  for (std::size_t step = 0; step < Access::steps(size) && !best.done(); ++step) {
    const unsigned there = Access::one_ray ? first_lanes(size - step * width) : all_lanes;
    meet_step(rays, block, step, all_lanes & ~there, best);
  }
}

/// The leaf_size that marks a child as a single capsule, and the child as its slot.
inline constexpr std::uint8_t one_capsule = 0xff;

/// A leaf as a node: the boxes of its first `size` capsules, rounded outward.
BOULE_INLINE void make_node(const CapsuleBlock& block, std::size_t first_slot, std::size_t size,
                            BvhNode& node) {
  const Real outward(static_cast<float>(1 + filter::box_step));
  const Real step(static_cast<float>(2 * filter::box_step));
  const auto lower = [&](const Real& x) { return filter_fnma(abs(x), step, x); };
  const auto upper = [&](const Real& x) { return filter_fma(abs(x), step, x); };
  for (std::size_t at = 0; at < bvh_leaf_size; at += width) {
    const Real r = abs(load(block.radius + at)) * outward;
    const auto set = [&](const float* a, const float* b, float* min, float* max) {
      const Real from = load(a + at), to = load(b + at);
      store(min + at, lower(filter_min(from, to) - r));
      store(max + at, upper(filter_max(from, to) + r));
    };
    set(block.a_x, block.b_x, node.min_x, node.max_x);
    set(block.a_y, block.b_y, node.min_y, node.max_y);
    set(block.a_z, block.b_z, node.min_z, node.max_z);
    store(node.child + at, count_from(static_cast<std::uint32_t>(first_slot + at)));
  }
  __builtin_memset(node.leaf_size, one_capsule, sizeof node.leaf_size);
  node.size = static_cast<std::uint8_t>(size);
}

/// Searches the tree. A packet visits the boxes of a leaf's capsules as it visits those of a node.
template <class Access, class Walk, class Best>
BOULE_INLINE void traverse_capsules(const RayLanes& rays, const CapsuleView& capsules, Walk& walk,
                                    Best& best) {
  BvhNode leaf;
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
      continue;
    }
    if (visit.leaf_size == one_capsule) {
      meet_one(rays, capsules, visit.child, all_lanes & ~lanes, best);
    } else {
      const std::size_t slot = capsules.scanned + index_of(visit.child) * bvh_leaf_size;
      if constexpr (!Access::one_ray) {
        make_node(capsules.blocks[slot / bvh_leaf_size], slot, visit.leaf_size, leaf);
        walk.visit_children(leaf, lanes, best.limit(), limit, stack);
        continue;
      }
      meet_block<Access>(rays, capsules, slot, visit.leaf_size, best);
    }
    limit = limit_of_all<Access>(best.limit());
  }
}

/// Searches all capsules.
template <class Access, class Best>
BOULE_INLINE void search_capsules(const RayLanes& rays, const CapsuleView& capsules, Best& best) {
  for (std::size_t slot = 0; slot < capsules.scanned && !best.done(); slot += bvh_leaf_size)
    meet_block<Access>(rays, capsules, slot, bvh_leaf_size, best);
  if (capsules.bvh.size == 0) return;
  with_walk<Access>(rays, best, capsules.bvh, [&](auto& walk) -> std::size_t {
    traverse_capsules<Access>(rays, capsules, walk, best);
    return 0;
  });
}

}  // namespace boule::BOULE_KERNEL_ISA
