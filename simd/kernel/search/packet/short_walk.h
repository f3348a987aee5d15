#pragma once

#include <bit>
#include <cstddef>

#include "simd/kernel/search/leaf/best_hit.h"
#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/packet/packet_walk.h"
#include "simd/kernel/search/packet/ray_by_ray.h"
#include "simd/kernel/search/packet/reach_box.h"
#include "simd/kernel/search/packet/visit_stack.h"
#include "simd/kernel/tuning.h"

/// The traversal of a tree by packets of short any-hit rays: one packet, or two that share their
/// visits. (Nearest hits shorten rays again and again, while a reach box is made once.)
namespace boule::BOULE_KERNEL_ISA {

/// The rays: the lanes of the first packet, then those of the second, as bits.
template <int packets>
class ShortWalk {
 public:
  /// `rays`: of each packet. `reach`: of all of them; is_short(). `untested`: up to this many
  /// children are visited without a test of their boxes by the rays. `extent`: BvhView::extent.
  BOULE_INLINE ShortWalk(const RayLanes* rays, const ReachBox& reach, int untested, float extent)
      : rays_(rays), reach_(reach), untested_(untested), extent_(extent) {
    for (int p = 0; p < packets; ++p) one_by_one_[p] = RayByRay(rays[p], extent);
  }
  /// The rays of packet p, as bits of its lanes.
  BOULE_INLINE static unsigned of_packet(unsigned lanes, int p) {
    return lanes >> p * width & all_lanes;
  }

  /// Adds the children of a node that some ray of `lanes` may enter before its limit.
  BOULE_INLINE void visit_children(const BvhNode& node, unsigned lanes, const Real* limits,
                                   VisitStack& stack) {
    const bool few = is_for_few(lanes);
    unsigned in = (1U << node.size) - 1;
    if (!few) {
      in &= reach_.enter(node);
      if (count_bits(in) <= untested_) {
        for (; in != 0; in &= in - 1) push_if(true, node, std::countr_zero(in), lanes, stack);
        return;
      }
    }
    make_boxes();
    if (few || is_by_ray(lanes, in)) {
      visit_by_rays(node, lanes, in, limits, stack);
    } else {
      visit_by_boxes(node, lanes, in, limits, stack);
    }
  }
  /// The spheres of a leaf within reach of the rays `lanes`, as bits.
  [[nodiscard]] BOULE_INLINE unsigned reach(const LeafSpheres<OneForAll>& leaf,
                                            unsigned lanes) const {
    const unsigned all_spheres = (1U << leaf.size) - 1;
    return is_for_few(lanes) ? all_spheres : reach_.meet(leaf.leaf) & all_spheres;
  }
  /// Lists the spheres among `in` of a leaf that float cannot rule out for every ray of packet p
  /// that is among its `lanes`.
  BOULE_INLINE void list_survivors(int p, const LeafSpheres<OneForAll>& leaf, unsigned lanes,
                                   unsigned in, const Real& limit,
                                   Survivors<bvh_leaf_size>& survivors) const {
    if (one_by_one_[p].is_for(lanes, in)) {
      one_by_one_[p].list_survivors(leaf, lanes, in, limit, survivors);
    } else {
      list_among(rays_[p].filter, leaf, 0, in, lanes, survivors);
    }
  }

  /// As a walk of traverse.h, where there is one packet.
  BOULE_INLINE void visit_children(const BvhNode& node, unsigned lanes, const Real& limit, float,
                                   VisitStack& stack) {
    static_assert(packets == 1);
    visit_children(node, lanes, &limit, stack);
  }
  BOULE_INLINE void list_survivors(const LeafSpheres<OneForAll>& leaf, unsigned lanes,
                                   const Real& limit, float,
                                   Survivors<bvh_leaf_size>& survivors) const {
    static_assert(packets == 1);
    list_survivors(0, leaf, lanes, reach(leaf, lanes), limit, survivors);
  }

 private:
  BOULE_INLINE void visit_by_rays(const BvhNode& node, unsigned lanes, unsigned in,
                                  const Real* limits, VisitStack& stack) {
    RayByRay::Entered entered[packets];
    unsigned by_any = 0;
    for (int p = 0; p < packets; ++p) {
      if (of_packet(lanes, p) == 0) continue;
      one_by_one_[p].template enter<false>(box_rays_[p], node, of_packet(lanes, p), in, limits[p],
                                           entered[p]);
      by_any |= entered[p].in;
    }
    for (in &= by_any; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      unsigned entering = 0;
      for (int p = 0; p < packets; ++p) entering |= entered[p].lanes(k) << p * width;
      push_if(true, node, k, entering, stack);
    }
  }
  BOULE_INLINE void visit_by_boxes(const BvhNode& node, unsigned lanes, unsigned in,
                                   const Real* limits, VisitStack& stack) {
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      unsigned entering = 0;
      for (int p = 0; p < packets; ++p) {
        entering |= (all_lanes & ~bits(enter_child(box_rays_[p], node, k, limits[p]).out))
                    << p * width;
      }
      push_if((entering & lanes) != 0, node, k, entering & lanes, stack);
    }
  }
  BOULE_INLINE static void push_if(bool really, const BvhNode& node, int k, unsigned lanes,
                                   VisitStack& stack) {
    stack.push_if(really, {-static_cast<float>(no_hit), node.child[k], node.leaf_size[k], lanes});
  }

  [[nodiscard]] BOULE_INLINE bool may_be_by_ray() const {
    bool may = true;
    for (int p = 0; p < packets; ++p) may = may && one_by_one_[p].may();
    return may;
  }
  /// Whether the rays are few enough to be tested one by one before any other test.
  [[nodiscard]] BOULE_INLINE bool is_for_few(unsigned lanes) const {
    return count_bits(lanes) <= tuning::most_rays_alone && may_be_by_ray();
  }
  /// RayByRay::is_for() of all packets together.
  [[nodiscard]] BOULE_INLINE bool is_by_ray(unsigned lanes, unsigned in) const {
    return count_bits(lanes) * static_cast<int>(bvh_width / width) <= count_bits(in) * packets &&
           may_be_by_ray();
  }

  /// Called only when a box is to be tested: many packets of short rays need none.
  BOULE_INLINE void make_boxes() {
    if (has_boxes_) return;
    for (int p = 0; p < packets; ++p) box_rays_[p] = BoxRays(rays_[p], extent_);
    has_boxes_ = true;
  }

  const RayLanes* rays_;
  const ReachBox& reach_;
  int untested_;
  float extent_;
  BoxRays box_rays_[packets];  ///< of make_boxes()
  bool has_boxes_ = false;
  RayByRay one_by_one_[packets];
};

}  // namespace boule::BOULE_KERNEL_ISA
