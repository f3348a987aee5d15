#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/root_bounds.h"
#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/leaf/slabs.h"
#include "simd/kernel/search/packet/visit_stack.h"

/// The rays of a packet one by one, each against W boxes or W spheres at a time. Chosen where few
/// rays of a packet are left: that takes fewer steps than box after box and sphere after sphere.
/// Every comparison with NaN rejects, as in flights (flight.h). Therefore this file requires rays
/// that float can judge, without hits behind their origins, and trees within the range of the
/// filters.
namespace boule::BOULE_KERNEL_ISA {

/// The number in one lane.
BOULE_INLINE float get_lane(const Real& lanes, std::size_t lane) {
  float value = 0;
  __builtin_memcpy(&value, reinterpret_cast<const char*>(&lanes) + lane * sizeof value,
                   sizeof value);
  return value;
}
BOULE_INLINE std::uint32_t get_lane(const Bits& lanes, std::size_t lane) {
  std::uint32_t value = 0;
  __builtin_memcpy(&value, reinterpret_cast<const char*>(&lanes) + lane * sizeof value,
                   sizeof value);
  return value;
}
/// The vector in one lane, in every lane.
BOULE_INLINE Vec3<Real> get_lane(const Vec3<Real>& lanes, std::size_t lane) {
  return {get_lane(lanes.x, lane), get_lane(lanes.y, lane), get_lane(lanes.z, lane)};
}

class RayByRay {
 public:
  /// Boxes or spheres, up to sixteen, that some rays meet.
  struct Met {
    unsigned in = 0;  ///< as bits
    Bits rows{0U};    ///< by ray, the boxes or spheres that it meets, as bits

    /// Adds the ray of a lane, and the boxes or spheres that it meets.
    BOULE_INLINE void add(std::size_t lane, unsigned row) {
      in |= row;
      rows = select(count_from(0) == Bits(static_cast<std::uint32_t>(lane)), Bits(row), rows);
    }
    /// The rays that meet the k-th, as bits.
    [[nodiscard]] BOULE_INLINE unsigned lanes(int k) const {
      return all_lanes & ~bits((rows & Bits(1U << k)) == Bits(0U));
    }
  };
  struct Entered : Met {
    /// Lower bounds of the distances at which the first ray enters each, if requested.
    alignas(64) float near[bvh_width];
  };

  RayByRay() = default;
  /// `extent`: BvhView::extent.
  BOULE_INLINE RayByRay(const RayLanes& rays, float extent) : rays_(&rays) {
    const Real zero(0.0F);
    const Vec3<Real>& unit = rays.filter.unit;
    may_ = extent < filter::limit && all(is_judged(rays.filter));
    down_[0] = bits(unit.x < zero);
    down_[1] = bits(unit.y < zero);
    down_[2] = bits(unit.z < zero);
  }
  /// Whether it takes fewer steps to test the rays `lanes` one by one than to test all rays against
  /// `in`, up to sixteen boxes or spheres, both as bits.
  [[nodiscard]] BOULE_INLINE bool is_for(unsigned lanes, unsigned in) const {
    return may_ && count_bits(lanes) * static_cast<int>(parts) <= count_bits(in);
  }

  /// Whether rays may be tested one by one at all.
  [[nodiscard]] BOULE_INLINE bool may() const { return may_; }

  /// Adds the children among `in` of a node that some ray of `lanes` enters before its limit.
  template <bool ordered>
  BOULE_INLINE void visit_children(const BoxRays& boxes, const BvhNode& node, unsigned lanes,
                                   unsigned in, const Real& limit, VisitStack& stack) const {
    const int base = stack.count();
    Entered entered;
    enter<ordered>(boxes, node, lanes, in, limit, entered);
    for (in &= entered.in; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      Visit visit{-static_cast<float>(no_hit), node.child[k], node.leaf_size[k], entered.lanes(k)};
      if constexpr (ordered) {
        visit.near = entered.near[k];
        stack.push(visit, base);
      } else {
        stack.push_if(true, visit);
      }
    }
  }
  /// Lists the spheres among `in` of a leaf that some ray of `lanes` may hit before its limit.
  BOULE_INLINE void list_survivors(const LeafSpheres<OneForAll>& leaf, unsigned lanes, unsigned in,
                                   const Real& limit, Survivors<bvh_leaf_size>& survivors) const {
    Met met;
    meet(leaf, lanes, limit, met);
    for (in &= met.in; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      survivors.append(static_cast<std::uint32_t>(k), all_lanes & ~met.lanes(k));
    }
  }

  /// Finds the children among `in` of a node that the rays `lanes` enter before their limits, and,
  /// if `ordered`, at which distance.
  template <bool ordered>
  BOULE_NOINLINE void enter(const BoxRays& boxes, const BvhNode& node, unsigned lanes, unsigned in,
                            const Real& limit, Entered& entered) const {
    Real first[parts];
    for (Real& near : first) near = Real(static_cast<float>(no_hit));
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      unsigned row = 0;
      for (std::size_t part = 0; part < parts; ++part) {
        if (!has_part(in, part)) continue;
        row |= enter_part(boxes, node, lane, get_lane(limit, lane), part, first[part])
               << part * width;
      }
      entered.add(lane, row);
    }
    if constexpr (ordered) {
      for (std::size_t part = 0; part < parts; ++part)
        store(entered.near + part * width, first[part]);
    }
  }

 private:
  static constexpr std::size_t parts = bvh_width / width;
  static_assert(bvh_width == bvh_leaf_size);

  /// Whether some of the bits belong to the part-th W boxes or spheres.
  BOULE_INLINE static bool has_part(unsigned in, std::size_t part) {
    return parts == 1 || (in >> part * width & all_lanes) != 0;
  }

  /// One ray against W children. Lowers `first` to the distances at which it enters them.
  BOULE_INLINE unsigned enter_part(const BoxRays& boxes, const BvhNode& node, std::size_t lane,
                                   float limit, std::size_t part, Real& first) const {
    static_assert(offsetof(BvhNode, max_z) == 5 * bvh_width * sizeof(float));
    const auto* const rows = reinterpret_cast<const float*>(&node) + part * width;
    // The row of the planes that are crossed first is `axis`, or axis + 3 where the ray goes down.
    const auto meet = [&](const Slab& slab, std::size_t row, const Real& moved) {
      return filter_fma(load(rows + row * bvh_width), Real(get_lane(slab.inverse, lane)),
                        Real(get_lane(moved, lane)));
    };
    const auto near_of = [&](const Slab& slab, std::size_t axis) {
      return meet(slab, axis + 3 * (down_[axis] >> lane & 1U), slab.near);
    };
    const auto far_of = [&](const Slab& slab, std::size_t axis) {
      return meet(slab, axis + 3 - 3 * (down_[axis] >> lane & 1U), slab.far);
    };
    const auto& [x, y, z] = boxes.slabs;
    const auto [near, in] = pass_boxes({near_of(x, 0), near_of(y, 1), near_of(z, 2)},
                                       {far_of(x, 0), far_of(y, 1), far_of(z, 2)}, limit);
    first = select(in & (near < first), near, first);
    return bits(in);
  }

  /// Finds the spheres of a leaf that the rays `lanes` may hit before their limits.
  BOULE_NOINLINE void meet(const LeafSpheres<OneForAll>& leaf, unsigned lanes, const Real& limit,
                           Met& met) const {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const Real until(get_lane(limit, lane));
      unsigned row = 0;
      for (std::size_t part = 0; part < parts; ++part)
        row |= meet_part(lane, leaf.leaf, part, until) << part * width;
      met.add(lane, row);
    }
  }
  /// One ray against W spheres. The ray's own sphere may be among them; list_candidates() handles
  /// it.
  BOULE_INLINE unsigned meet_part(std::size_t lane, const SphereBlock& leaf, std::size_t part,
                                  const Real& limit) const {
    const std::size_t at = part * width;
    const Vec3<Real> center{load(leaf.center_x + at), load(leaf.center_y + at),
                            load(leaf.center_z + at)};
    return bits(RejectSpheres(center, load(leaf.radius + at))
                    .may_meet(get_lane(rays_->filter.org, lane), get_lane(rays_->filter.h, lane),
                              get_lane(rays_->filter.origin_error, lane), limit));
  }

  const RayLanes* rays_;
  unsigned down_[3];  ///< the rays that go down along an axis, as bits
  bool may_;
};

}  // namespace boule::BOULE_KERNEL_ISA
