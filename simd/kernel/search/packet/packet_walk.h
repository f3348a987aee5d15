#pragma once

#include <bit>
#include <cstdint>

#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/packet/beam.h"
#include "simd/kernel/search/packet/ray_by_ray.h"
#include "simd/kernel/search/packet/visit_stack.h"

/// The traversal of a tree by packets: the children of a node that they visit, with which of their
/// rays, and the spheres of a leaf that they may hit. Few rays are tested one by one
/// (ray_by_ray.h), many rays box by box and sphere by sphere, whichever takes fewer steps.
namespace boule::BOULE_KERNEL_ISA {

/// The distance at which the first of the rays outside `out` enters a box; -inf where that is
/// unknown.
BOULE_INLINE float first_entry(const Entry& entry) {
  const Real never(static_cast<float>(no_hit)), unknown(-static_cast<float>(no_hit));
  const Real near = select(entry.near <= entry.near, entry.near, unknown);
  return least_lane(select(entry.out, never, near));
}

/// Packets against the box of child k.
BOULE_INLINE Entry enter_child(const BoxRays& rays, const BvhNode& node, int k, const Real& limit) {
  return enter_boxes(rays,
                     {{node.min_x[k], node.min_y[k], node.min_z[k]},
                      {node.max_x[k], node.max_y[k], node.max_z[k]}},
                     limit);
}

/// Lists those of sixteen spheres, given as bits from step `begin` on, that float cannot rule out
/// for every ray of `lanes`.
template <class Spheres>
BOULE_INLINE void list_among(const FilterRays& rays, const Spheres& spheres, std::size_t begin,
                             unsigned in, unsigned lanes, Survivors<bvh_leaf_size>& survivors) {
  const unsigned others = all_lanes & ~lanes;
  for (; in != 0; in &= in - 1) {
    const auto k = static_cast<std::uint32_t>(std::countr_zero(in));
    survivors.append(k, bits(spheres.out(rays, begin + k)) | others);
  }
}

/// A packet during traversal. `ordered`: the nearest child is visited first. `extent`:
/// BvhView::extent.
template <bool ordered>
class PacketWalk {
 public:
  BOULE_INLINE PacketWalk(const RayLanes& rays, float extent)
      : rays_(rays.filter),
        box_rays_(rays, extent),
        beam_(box_rays_, rays.filter, extent),
        one_by_one_(rays, extent) {}

  /// Adds the children of a node that some ray of `lanes` enters before its limit. `farthest`: the
  /// largest of the limits.
  BOULE_INLINE void visit_children(const BvhNode& node, unsigned lanes, const Real& limit,
                                   float farthest, VisitStack& stack) const {
    const int base = stack.count();
    alignas(64) float near[bvh_width];
    unsigned in = (1U << node.size) - 1;
    if (beam_.is_beam()) in &= beam_.enter(node, farthest, near);
    if (one_by_one_.is_for(lanes, in)) {
      one_by_one_.visit_children<ordered>(box_rays_, node, lanes, in, limit, stack);
    } else if (beam_.is_straight()) {
      const Beam::Rows rows = beam_.rows_of(node);
      for (; in != 0; in &= in - 1) {
        const int k = std::countr_zero(in);
        const Entry entry =
            enter_ordered(box_rays_, {rows.first_x[k], rows.first_y[k], rows.first_z[k]},
                          {rows.last_x[k], rows.last_y[k], rows.last_z[k]}, limit);
        push(node, k, entry, lanes, near + k, base, stack);
      }
    } else {
      for (; in != 0; in &= in - 1) {
        const int k = std::countr_zero(in);
        push(node, k, enter_child(box_rays_, node, k, limit), lanes, nullptr, base, stack);
      }
    }
  }

  /// Lists the spheres of a leaf that float cannot rule out for every ray of `lanes`.
  BOULE_INLINE void list_survivors(const LeafSpheres<OneForAll>& leaf, unsigned lanes,
                                   const Real& limit, float farthest,
                                   Survivors<bvh_leaf_size>& survivors) const {
    unsigned in = (1U << leaf.size) - 1;
    if (beam_.is_beam()) in &= beam_.meet(leaf.leaf, farthest);
    if (one_by_one_.is_for(lanes, in)) {
      one_by_one_.list_survivors(leaf, lanes, in, limit, survivors);
    } else if (beam_.is_beam()) {
      list_among(rays_, leaf, 0, in, lanes, survivors);
    } else {
      const auto out = [&](std::size_t step) { return leaf.out(rays_, step); };
      boule::BOULE_KERNEL_ISA::list_survivors(out, 0, leaf.size, survivors);
      for (std::size_t k = 0; k < survivors.count; ++k) survivors.out[k] |= all_lanes & ~lanes;
    }
  }

 private:
  /// Adds child k, unless all of `lanes` are out. `near`: the distance at which the beam enters it,
  /// or null.
  BOULE_INLINE static void push(const BvhNode& node, int k, const Entry& entry, unsigned lanes,
                                const float* near, int base, VisitStack& stack) {
    const unsigned in = ~bits(entry.out) & lanes;
    Visit visit{-static_cast<float>(no_hit), node.child[k], node.leaf_size[k], in};
    if constexpr (!ordered) {
      stack.push_if(in != 0, visit);
    } else if (in != 0) {
      visit.near = near != nullptr ? *near : first_entry(entry);
      stack.push(visit, base);
    }
  }

  const FilterRays& rays_;
  BoxRays box_rays_;
  Beam beam_;
  RayByRay one_by_one_;
};

}  // namespace boule::BOULE_KERNEL_ISA
