#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/flock/pending_children.h"
#include "simd/kernel/search/leaf/root_bounds.h"
#include "simd/kernel/search/leaf/slabs.h"
#include "simd/kernel/tuning.h"

/// The traversal by one ray, in steps: each visits a node or a leaf, W children or W spheres at a
/// time. Between two steps the state is in memory, so that other rays can take their steps while
/// the data of the next one are fetched (flight_stream.h). Rays of sets (ray_sets.h) take the same
/// steps in another order.
namespace boule::BOULE_KERNEL_ISA {

/// The data for the steps of one ray, as rows of four floats, which Departures copies whole. The
/// ray has no hits behind its origin.
struct alignas(16) FlightRay {
  static constexpr std::size_t rows = 6;
  float inverse[3], reach;  ///< reach: largest t |dir| that counts
  float near[3], live_from;
  float far[3], live_to;
  float org[3], origin_error;
  float unit[3], unused;
  float h[3], unused_too;  ///< h of FilterRays, for the reject

  BOULE_INLINE static Vec3<Real> all(const float* v) { return {v[0], v[1], v[2]}; }
  /// The ray in every lane, without the data that only a reject needs.
  [[nodiscard]] BOULE_INLINE FilterRays filter() const {
    FilterRays rays;
    rays.org = all(org);
    rays.unit = all(unit);
    rays.origin_error = origin_error;
    rays.live_from = live_from;
    rays.live_to = live_to;
    rays.dead_below = 0.0F;
    return rays;
  }
};

/// The FlightRays of W rays.
class FlightRows {
 public:
  /// `extent`: BvhView::extent. `reach`: the largest t |dir| that counts.
  BOULE_INLINE void set(const RayLanes& packet, float extent, const Real& reach) {
    const FilterRays& rays = packet.filter;
    const auto [x, y, z] = slabs_of(packet.exact, rays, extent);
    store_rows(row_[0][0], {x.inverse, y.inverse, z.inverse, reach});
    store_rows(row_[1][0], {x.near, y.near, z.near, rays.live_from});
    store_rows(row_[2][0], {x.far, y.far, z.far, rays.live_to});
    store_rows(row_[3][0], {rays.org.x, rays.org.y, rays.org.z, rays.origin_error});
    store_rows(row_[4][0], {rays.unit.x, rays.unit.y, rays.unit.z, rays.unit.z});
    store_rows(row_[5][0], {rays.h.x, rays.h.y, rays.h.z, rays.h.z});
  }
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    static_assert(sizeof(FlightRay) == sizeof row_ / width);
    get<0>(lane, ray);
    get<1>(lane, ray);
    get<2>(lane, ray);
    get<3>(lane, ray);
    get<4>(lane, ray);
    get<5>(lane, ray);
  }

 private:
  template <std::size_t row>
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    constexpr std::size_t size = sizeof row_[row][0];
    __builtin_memcpy(reinterpret_cast<char*>(&ray) + row * size, row_[row][lane], size);
  }

  alignas(64) float row_[FlightRay::rows][width][4];
};

/// The offsets in a node, in floats, of the planes of its boxes that a ray crosses first along each
/// axis, and of those that it crosses last.
struct NodeRows {
  std::uint16_t near_at[3], far_at[3];

  /// Finds the offsets by the signs of `inverse`.
  BOULE_INLINE void choose(const FlightRay& ray) {
    choose(0, ray.inverse[0]);
    choose(1, ray.inverse[1]);
    choose(2, ray.inverse[2]);
  }

 private:
  BOULE_INLINE void choose(std::uint32_t axis, float inverse) {
    const std::uint32_t down = std::bit_cast<std::uint32_t>(inverse) >> 31;
    near_at[axis] = static_cast<std::uint16_t>((axis + 3 * down) * bvh_width);
    far_at[axis] = static_cast<std::uint16_t>((axis + 3 - 3 * down) * bvh_width);
  }
};

/// Enters W children of a node, from `first` on.
BOULE_INLINE Passage enter_children(const FlightRay& ray, const NodeRows& at, const BvhNode& node,
                                    std::size_t first) {
  static_assert(offsetof(BvhNode, max_z) == 5 * bvh_width * sizeof(float));
  const auto* const rows = reinterpret_cast<const float*>(&node) + first;
  const auto meet = [&](const std::uint16_t* row, const float* moved, int axis) {
    return filter_fma(load(rows + row[axis]), Real(ray.inverse[axis]), Real(moved[axis]));
  };
  const auto near_of = [&](int axis) { return meet(at.near_at, ray.near, axis); };
  const auto far_of = [&](int axis) { return meet(at.far_at, ray.far, axis); };
  return pass_boxes({near_of(0), near_of(1), near_of(2)}, {far_of(0), far_of(1), far_of(2)},
                    ray.reach);
}

/// Float bounds of the hits of one ray, without hits behind its origin, with W spheres. The hit
/// with a sphere is its first root, or its second where the origin may lie inside.
struct NextRoots {
  RealMask in;     ///< spheres that may be hit before `reach`
  RealMask sure;   ///< hits that are certain, unless `high` is NaN
  Real low, high;  ///< bounds of the hit; `high` is NaN where the line may miss the sphere

  /// Spheres in the lanes `left_out` are never `in`.
  BOULE_INLINE NextRoots(const Approach& approach, const FilterRays& rays, const Real& reach,
                         const RealMask& left_out) {
    const auto& [b, discriminant, spread, doubt] = approach;
    const Real most = sqrt(discriminant + doubt), least = sqrt(discriminant - doubt);
    low = b - spread - most;
    high = b + spread - least;
    const Real second_high = b + spread + most;
    // NaN comes from spheres that the line misses and from empty slots: they are never in.
    in = (Real(0.0F) <= second_high) & (low <= reach) & ~left_out;
    sure = in & (rays.live_from < low);
    const RealMask around = in & ~sure;
    if (any(around)) turn_to_second(around, b - spread + least, second_high, rays, reach);
  }

 private:
  BOULE_INLINE void turn_to_second(const RealMask& around, const Real& second_low,
                                   const Real& second_high, const FilterRays& rays,
                                   const Real& reach) {
    low = select(around & (high < Real(0.0F)), second_low, low);
    in = in & (low <= reach);
    sure = sure | (around & (rays.live_from < second_low));
    high = select(around, second_high, high);
  }
};

/// Spheres that may be a flight's nearest hit. The double solver decides at the end of the flight.
struct FlightCandidates {
  /// Above `most` candidates they are solved at once; those of one more leaf still find room.
  static constexpr unsigned most = tuning::most_candidates;
  static constexpr unsigned capacity = 32;
  static_assert(most + bvh_leaf_size <= capacity);

  alignas(64) float low[capacity];  ///< lower bounds of their hits
  alignas(64) std::uint32_t slot[capacity];
  unsigned size = 0;

  /// Adds the spheres in the lanes `chosen`.
  BOULE_INLINE void add(const Real& lower, const Bits& slots, unsigned chosen) {
    store_chosen(low + size, lower, chosen);
    store_chosen(slot + size, slots, chosen);
    size += static_cast<unsigned>(std::popcount(chosen));
  }
  /// Of W candidates from `first` on, those that may be hit before `reach`, as bits.
  [[nodiscard]] BOULE_INLINE unsigned before(float reach, unsigned first) const {
    const unsigned left = size - first;
    const unsigned there = left < width ? (1U << left) - 1 : all_lanes;
    return bits(load(low + first) <= Real(reach)) & there;
  }
  /// Drops the candidates that are hit beyond `reach`.
  BOULE_INLINE void drop_beyond(float reach) {
    const unsigned count = size;
    size = 0;
    for (unsigned k = 0; k < count; ++k) {
      low[size] = low[k];
      slot[size] = slot[k];
      size += reach < low[k] ? 0 : 1;
    }
  }
};

/// A ray of a flight or a set, during traversal.
struct TreeRay {
  FlightRay ray;
  NodeRows rows;
  std::int32_t source;  ///< id of the primitive that it leaves, or -1
  std::uint32_t index;  ///< in the stream
  bool inside;          ///< it leaves `source` on its inside
};

/// A ray in flight.
struct Flight : TreeRay {
  const void* next;  ///< the node or the leaf of the next step
  FlightCandidates candidates;
  PendingChildren pending;

  /// A step: adds the children of a node that the ray enters to the pending ones.
  BOULE_INLINE void visit_node() {
    constexpr std::size_t parts = bvh_width / width;
    const BvhNode& node = *static_cast<const BvhNode*>(next);
    if constexpr (parts == 2) {  // both are entered before either is added, which shares their
                                 // loads
      const auto [near, in] = enter_children(ray, rows, node, 0);
      const auto [other_near, other_in] = enter_children(ray, rows, node, width);
      pending.push(near, load_integers(node.child), in);
      pending.push(other_near, load_integers(node.child + width), other_in);
    } else {
      for (std::size_t first = 0; first < bvh_width; first += width) {
        const auto [near, in] = enter_children(ray, rows, node, first);
        pending.push(near, load_integers(node.child + first), in);
      }
    }
  }
};

}  // namespace boule::BOULE_KERNEL_ISA
