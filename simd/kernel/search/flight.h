#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/packet_stream.h"
#include "simd/kernel/search/slabs.h"

/// One ray on its own way through the tree, in steps: a node or a leaf each. Between two steps its
/// state lies in memory, so that other rays can take theirs (flight_stream.h).
namespace boule::BOULE_KERNEL_ISA {

/// Nodes and leaves that a ray is still to visit, where any hit will do: the last come first.
class PendingStack {
 public:
  BOULE_INLINE void clear() { size_ = 0; }
  /// Adds the children of some lanes.
  BOULE_INLINE void push(const Real&, const Real& child, RealMask chosen) {
    const unsigned in = bits(chosen);
    store_chosen(child_ + size_, child, in);
    size_ += static_cast<std::size_t>(std::popcount(in));
  }
  /// Takes the last; false if nothing is left, and `child` is then anything.
  BOULE_INLINE bool pop(float, std::uint32_t& child) {
    const bool left = size_ != 0;
    size_ -= static_cast<std::size_t>(left);
    child = std::bit_cast<std::uint32_t>(child_[size_]);
    return left;
  }

 private:
  /// A push writes W.
  static constexpr std::size_t capacity = bvh_max_depth * (bvh_width - 1) + 1 + lanes;
  float child_[capacity];
  std::size_t size_ = 0;
};

/// The same where the nearest hit is wanted, as an unsorted array: the nearest comes first, and is
/// looked for when it is. Of where a box is entered 16 bits are kept, rounded down: eight of
/// exponent and eight of mantissa.
class PendingNearest {
 public:
  PendingNearest() {
    size_ = most_sorted;
    clear();
  }

  BOULE_INLINE void clear() {
    std::size_t at = 0;
    do {  // once, for nearly every ray
      __builtin_memset(near_ + at, 0xff, step * sizeof near_[0]);
      at += step;
    } while (at < size_);
    size_ = 0;
  }
  /// Adds the children of some lanes; `near`: lower bounds of where they are entered, not negative.
  BOULE_INLINE void push(const Real& near, const Real& child, RealMask chosen) {
    const unsigned in = bits(chosen);
    store_chosen_halves(near_ + size_, near, chosen, Real(std::bit_cast<float>(0xffffffff)));
    store_chosen(child_ + size_, child, in);
    size_ += static_cast<std::size_t>(std::popcount(in));
  }

  /// Takes the nearest; false if none is entered before `reach`, and `child` is then anything. No
  /// branch: neither can be foretold.
  BOULE_INLINE bool pop(float reach, std::uint32_t& child) {
    const unsigned end = half_of(reach);
    while (size_ > most_sorted && end < near_[size_ - 1]) --size_;
    const std::size_t place = size_ <= most_sorted ? nearest() : size_ - 1;
    const bool left = near_[place] <= end;
    child = std::bit_cast<std::uint32_t>(child_[place]);
    size_ -= static_cast<std::size_t>(left);
    near_[place] = near_[size_];
    child_[place] = child_[size_];
    near_[size_] = none;
    return left;
  }

 private:
  /// Entries that are looked at in one go.
  static constexpr std::size_t step = 16;
  /// Beyond everything: infinity is 0xff00.
  static constexpr std::uint16_t none = 0xffff;

  BOULE_INLINE static std::uint16_t half_of(float near) {
    return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(near) << 1 >> 16);
  }
  BOULE_INLINE std::size_t nearest() const {
    std::size_t place = place_of_least(near_);
    for (std::size_t first = step; first < size_; first += step) {
      const std::size_t other = first + place_of_least(near_ + first);
      place = near_[other] < near_[place] ? other : place;
    }
    return place;
  }

  /// Of more than these the last one is taken, whatever it is: a way down the tree then bounds what
  /// can be added.
  static constexpr std::size_t most_sorted = 48;
  static constexpr std::size_t most = most_sorted + bvh_max_depth * (bvh_width - 1) + 1;
  /// A push writes W.
  static constexpr std::size_t capacity = (most + lanes + step - 1) / step * step;

  alignas(64) std::uint16_t near_[capacity];  ///< none behind the last, as far as it is looked at
  alignas(64) float child_[capacity];
  std::size_t size_ = 0;
};

/// What one ray's steps need, in rows of four floats. It does not look behind its origin.
struct alignas(16) FlightRay {
  static constexpr std::size_t rows = 5;
  float inverse[3], reach;  ///< reach: upper bound of t |dir| of what is of interest
  float near[3], live_from;
  float far[3], live_to;
  float org[3], origin_error;
  float unit[3], unused;

  BOULE_INLINE static Vec3<Real> all(const float* v) { return {v[0], v[1], v[2]}; }
  /// In every lane; without what only a reject needs.
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

/// What float knows of the roots that may be the hit of a ray which does not look behind its
/// origin: of the first ones, but of the second where the origin may lie in the sphere.
struct NextRoots {
  RealMask in;     ///< spheres that may be hit
  RealMask sure;   ///< roots that are live for certain, unless `high` is NaN
  Real low, high;  ///< bounds; NaN where the line does not meet the sphere for certain

  /// Not of spheres in `left_out` lanes, nor of those that begin beyond `reach`.
  BOULE_INLINE NextRoots(const Approach& approach, const FilterRays& rays, const Real& reach,
                         const RealMask& left_out) {
    const auto& [b, discriminant, spread, doubt] = approach;
    const Real most = sqrt(discriminant + doubt), least = sqrt(discriminant - doubt);
    low = b - spread - most;
    high = b + spread - least;
    const Real second_high = b + spread + most;
    // NaN, of spheres that the line misses or that are not there, is never in.
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

/// Spheres that may be the nearest hit: only a double solve tells.
struct FlightCandidates {
  /// More are too many, but those of one more leaf find room.
  static constexpr unsigned most = 8;
  static constexpr unsigned capacity = 32;

  alignas(64) float low[capacity];   ///< lower bounds of their roots
  alignas(64) float slot[capacity];  ///< bits
  unsigned size = 0;

  /// The spheres in some lanes.
  BOULE_INLINE void add(const Real& lower, const Real& slots, unsigned chosen) {
    store_chosen(low + size, lower, chosen);
    store_chosen(slot + size, slots, chosen);
    size += static_cast<unsigned>(std::popcount(chosen));
  }
  /// Of W of them from `first` on those that do not begin beyond `reach`, bit by bit.
  [[nodiscard]] BOULE_INLINE unsigned before(float reach, unsigned first) const {
    const unsigned left = size - first;
    const unsigned there = left < lanes ? (1U << left) - 1 : all_lanes;
    return bits(load(low + first) <= Real(reach)) & there;
  }
  /// Forgets those that begin beyond `reach`.
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

/// A ray in flight.
template <class PendingVisits>
struct Flight {
  FlightRay ray;
  std::uint32_t near_at[3];  ///< the rows of a node's planes that are met first
  std::uint32_t far_at[3];   ///< and of the others
  std::int32_t source;
  bool inside;
  std::uint32_t index;  ///< in the stream
  const void* next;     ///< the node or the leaf of the next step
  FlightCandidates candidates;
  PendingVisits pending;

  /// Chooses the rows by the signs of `ray.inverse`.
  BOULE_INLINE void choose_rows() {
    choose_row(0);
    choose_row(1);
    choose_row(2);
  }
  BOULE_INLINE void choose_row(std::uint32_t axis) {
    const std::uint32_t down = std::bit_cast<std::uint32_t>(ray.inverse[axis]) >> 31;
    near_at[axis] = (axis + 3 * down) * bvh_width;
    far_at[axis] = (axis + 3 - 3 * down) * bvh_width;
  }

  /// A step: the children that the ray enters become pending.
  BOULE_INLINE void visit_node() {
    constexpr std::size_t parts = bvh_width / lanes;
    const BvhNode& node = *static_cast<const BvhNode*>(next);
    if constexpr (parts == 2) {  // what both have in common is found once
      const auto [near, in] = enter(node, 0);
      const auto [other_near, other_in] = enter(node, lanes);
      pending.push(near, load_bits(node.child), in);
      pending.push(other_near, load_bits(node.child + lanes), other_in);
    } else {
      for (std::size_t first = 0; first < bvh_width; first += lanes) {
        const auto [near, in] = enter(node, first);
        pending.push(near, load_bits(node.child + first), in);
      }
    }
  }

 private:
  struct Entered {
    Real near;  ///< lower bound
    RealMask in;
  };
  /// Which of W children are entered, and where.
  [[nodiscard]] BOULE_INLINE Entered enter(const BvhNode& node, std::size_t first) const {
    static_assert(offsetof(BvhNode, max_z) == 5 * bvh_width * sizeof(float));
    const auto* const rows = reinterpret_cast<const float*>(&node) + first;
    const auto meet = [&](const std::uint32_t* row, const float* moved, int axis) {
      return filter_fma(load(rows + row[axis]), Real(ray.inverse[axis]), Real(moved[axis]));
    };
    const auto near_of = [&](int axis) { return meet(near_at, ray.near, axis); };
    const auto far_of = [&](int axis) { return meet(far_at, ray.far, axis); };
    const Real less(static_cast<float>(1 - 2 * filter::box * filter::u));
    const Real near =
        filter_max(filter_max(near_of(0), near_of(1)), filter_max(near_of(2), Real(0.0F))) * less;
    const Real far =
        filter_min(filter_min(far_of(0), far_of(1)), filter_min(far_of(2), Real(ray.reach)));
    return {near, near <= far};
  }
};

}  // namespace boule::BOULE_KERNEL_ISA
