#pragma once

#include <cstdint>

#include "simd/abi/bvh.h"
#include "simd/lanes/lanes.h"

/// The nodes and leaves that a packet, a single ray or a bundle has yet to visit.
namespace boule::BOULE_KERNEL_ISA {

/// A child to visit.
struct Visit {
  float near;  ///< lower bound of the distance at which the first ray enters it
  std::uint32_t child;
  std::uint32_t leaf_size;
  unsigned lanes = all_lanes;  ///< of packets, the rays that may enter it
};

/// Children to visit; among the children of one node, the nearest is on top. The size follows from
/// the depth of the tree.
class VisitStack {
 public:
  [[nodiscard]] bool empty() const { return count_ == 0; }
  BOULE_INLINE Visit pop() {
    --count_;
    return {near_[count_], child_[count_], leaf_size_[count_], lanes_[count_]};
  }
  /// Adds a child of a node and keeps the node's children in order, farthest first. `base` is the
  /// count before the first of them was added.
  BOULE_INLINE void push(const Visit& visit, int base) {
    int at = count_++;
    for (; at > base && near_[at - 1] < visit.near; --at) {
      near_[at] = near_[at - 1];
      child_[at] = child_[at - 1];
      leaf_size_[at] = leaf_size_[at - 1];
      lanes_[at] = lanes_[at - 1];
    }
    set(at, visit);
  }
  /// Adds a child in no order, if `really`; without a branch, because it is unpredictable.
  BOULE_INLINE void push_if(bool really, const Visit& visit) {
    set(count_, visit);
    count_ += really ? 1 : 0;
  }
  [[nodiscard]] int count() const { return count_; }
  /// The at-th child that was added.
  [[nodiscard]] std::uint32_t child(int at) const { return child_[at]; }

 private:
  BOULE_INLINE void set(int at, const Visit& visit) {
    near_[at] = visit.near;
    child_[at] = visit.child;
    leaf_size_[at] = static_cast<std::uint16_t>(visit.leaf_size);
    lanes_[at] = visit.lanes;
  }
  /// push_if() writes one more than it adds.
  static constexpr int room = bvh_max_depth * (bvh_width - 1) + 2;
  float near_[room];
  std::uint32_t child_[room], lanes_[room];
  std::uint16_t leaf_size_[room];
  int count_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
