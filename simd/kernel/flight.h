#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/packet_stream.h"

/// One ray on its own way through the tree, in steps: a node or a leaf each. Between two steps its
/// state lies in memory, so that other rays can take theirs (flights.h).
namespace boule::BOULE_KERNEL_ISA {

/// Arrays of eight come in so many parts, of so many lanes each that count.
inline constexpr std::size_t parts_of_eight = width < 8 ? 8 / lanes : 1;
inline constexpr unsigned part_lanes = width < 8 ? all_lanes : 0xffU;

/// Nodes and leaves that a ray is still to visit, as an unsorted array: the nearest is looked for
/// when it is wanted.
class PendingVisits {
 public:
  BOULE_INLINE void clear() { size_ = 0; }
  /// Adds the children of some lanes; `near`: lower bounds of where they are entered.
  BOULE_INLINE void push(const Real& near, const Real& child, unsigned chosen) {
    const std::size_t size = size_;
    store_chosen(near_ + size, near, chosen);
    store_chosen(child_ + size, child, chosen);
    size_ = static_cast<std::uint32_t>(size) + static_cast<std::uint32_t>(std::popcount(chosen));
  }
  /// To be called when all parts are pushed: what follows the last one is never the nearest.
  BOULE_INLINE void close() { store_anywhere(near_ + size_, static_cast<float>(no_hit)); }

  /// Takes the nearest; false if nothing is left that is entered before `reach`.
  BOULE_INLINE bool pop(float reach, std::uint32_t& child) {
    std::size_t size = size_;
    while (size > 0) {
      const bool sorted = size <= most_sorted;
      const std::size_t place = sorted ? nearest(size) : size - 1;
      const float near = near_[place];
      child = std::bit_cast<std::uint32_t>(child_[place]);
      --size;
      near_[place] = near_[size];
      child_[place] = child_[size];
      near_[size] = static_cast<float>(no_hit);
      if (!(reach < near)) {
        size_ = static_cast<std::uint32_t>(size);
        return true;
      }
      if (sorted) break;
    }
    size_ = 0;
    return false;
  }

 private:
  BOULE_INLINE std::size_t nearest(std::size_t size) const {
    Real least = load(near_);
    for (std::size_t first = lanes; first < size; first += lanes)
      least = filter_min(least, load(near_ + first));
    const Real nearest(least_lane(least));
    std::size_t first = 0;
    unsigned equal = bits(load(near_) <= nearest);
    for (; equal == 0; equal = bits(load(near_ + first) <= nearest)) first += lanes;
    return first + static_cast<std::size_t>(std::countr_zero(equal));
  }

  /// Of more than these the last one is taken, whatever it is: a way down the tree then bounds what
  /// can be added.
  static constexpr std::size_t most_sorted = 48;
  static constexpr std::size_t most = most_sorted + bvh_max_depth * (bvh_width - 1) + 1;
  /// What a push and close() write beyond it.
  static constexpr std::size_t capacity = (most + bvh_width + 2 * lanes + 15) / 16 * 16;

  alignas(64) float near_[capacity];
  alignas(64) float child_[capacity];
  std::uint32_t size_ = 0;
};

/// Where rays meet the planes of an axis: t = x inverse + near for the planes met first, x inverse
/// + far for the others, a little outward (filter_bounds.h, flight_least). `farthest`: the tree
/// ends before this distance.
struct FlightSlab {
  Real inverse, near, far;

  BOULE_INLINE FlightSlab(const Wide& org, const Real& unit, const Real& farthest) {
    const Real zero(0.0F), least(filter::flight_least), size = abs(unit);
    const RealMask tiny = size < least;
    const Real steep = Real(1.0F) / select(tiny, least, size);
    inverse = select(unit < zero, zero - steep, steep);
    const Real aside = select(tiny, farthest * Real(4 * filter::flight_least), zero);
    const Wide at = org * widen(inverse);
    const Wide slack = (widen(aside) + Wide(filter::floor)) * widen(steep);
    near = narrow(Wide(0.0) - at - slack);
    far = narrow(slack - at);
  }
};

/// What one ray's steps need, in rows of four floats.
struct alignas(16) FlightRay {
  static constexpr int rows = 6;
  float inverse[3], reach;  ///< reach: upper bound of t |dir| of what is of interest
  float near[3], live_from;
  float far[3], live_to;
  float org[3], origin_error;
  float h[3], unused;
  float unit[3], dead_below;

  BOULE_INLINE static Vec3<Real> all(const float* v) { return {v[0], v[1], v[2]}; }
  /// In every lane.
  [[nodiscard]] BOULE_INLINE FilterRays filter() const {
    FilterRays rays;
    rays.org = all(org);
    rays.h = all(h);
    rays.unit = all(unit);
    rays.origin_error = origin_error;
    rays.origins_exact = false;
    rays.live_from = live_from;
    rays.live_to = live_to;
    rays.dead_below = dead_below;
    return rays;
  }
};

/// Spheres that may be the nearest hit: only a double solve tells.
struct FlightCandidates {
  static constexpr unsigned capacity = 8;
  float low[capacity];  ///< lower bounds of their roots
  std::uint32_t slot[capacity];
  unsigned size = 0;

  BOULE_INLINE void add(float lower, std::uint32_t which) {
    low[size] = lower;
    slot[size++] = which;
  }
  /// Forgets those that begin beyond `reach`.
  BOULE_INLINE void drop_beyond(float reach) {
    unsigned kept = 0;
    for (unsigned k = 0; k < size; ++k) {
      low[kept] = low[k];
      slot[kept] = slot[k];
      kept += reach < low[k] ? 0 : 1;
    }
    size = kept;
  }
};

/// A ray in flight.
struct Flight {
  FlightRay ray;
  std::uint32_t near_at[3],
      far_at[3];  ///< the rows of a node's planes met first, and of the others
  std::int32_t source;
  bool inside;
  std::uint32_t index;  ///< in the stream
  const void* next;     ///< the node or the leaf of the next step
  FlightCandidates candidates;
  PendingVisits pending;

  /// Chooses the rows by the signs of `ray.inverse`.
  BOULE_INLINE void choose_rows() {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t down = std::bit_cast<std::uint32_t>(ray.inverse[axis]) >> 31;
      near_at[axis] = (axis + 3 * down) * bvh_width;
      far_at[axis] = (axis + 3 - 3 * down) * bvh_width;
    }
  }

  /// A step: the children that the ray enters become pending.
  BOULE_INLINE void visit_node() {
    const BvhNode& node = *static_cast<const BvhNode*>(next);
    static_assert(offsetof(BvhNode, max_z) == 5 * bvh_width * sizeof(float));
    const auto* const rows = reinterpret_cast<const float*>(&node);
    const Real less(static_cast<float>(1 - 2 * filter::box * filter::u));
    for (std::size_t part = 0; part < parts_of_eight; ++part) {
      const auto meet = [&](const std::uint32_t* at, const float* moved, int axis) {
        return filter_fma(load_of_eight(rows + at[axis], part), Real(ray.inverse[axis]),
                          Real(moved[axis]));
      };
      const auto near_of = [&](int axis) { return meet(near_at, ray.near, axis); };
      const auto far_of = [&](int axis) { return meet(far_at, ray.far, axis); };
      const Real near =
          filter_max(filter_max(near_of(0), near_of(1)), filter_max(near_of(2), Real(0.0F))) * less;
      const Real far =
          filter_min(filter_min(far_of(0), far_of(1)), filter_min(far_of(2), Real(ray.reach)));
      pending.push(near, load_bits_of_eight(node.child, part), bits(near <= far) & part_lanes);
    }
    pending.close();
  }
};

}  // namespace boule::BOULE_KERNEL_ISA
