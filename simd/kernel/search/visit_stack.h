#pragma once

#include <cstdint>

#include "simd/abi/bvh.h"
#include "simd/lanes/lanes.h"

/// The nodes and leaves that a packet, a single ray or a bundle is still to visit.
namespace boule::BOULE_KERNEL_ISA {

/// A child to visit.
struct Visit {
  float near;  ///< where the first ray enters it, or less
  std::uint32_t child;
  std::uint32_t leaf_size;
};

/// Children to visit, the nearest of those of one node on top. Its size follows from the depth of
/// the tree.
class VisitStack {
 public:
  [[nodiscard]] bool empty() const { return count_ == 0; }
  Visit pop() { return visits_[--count_]; }
  /// Adds a child of a node and keeps the node's children in order, farthest first. `base` is the
  /// count before the first of them was added.
  void push(const Visit& visit, int base) {
    int at = count_++;
    for (; at > base && visits_[at - 1].near < visit.near; --at) visits_[at] = visits_[at - 1];
    visits_[at] = visit;
  }
  /// Adds a child in no order, if `really`; without a branch, which no CPU could predict.
  void push_if(bool really, const Visit& visit) {
    visits_[count_] = visit;
    count_ += really ? 1 : 0;
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  /// push_if() writes one more than it adds.
  Visit visits_[bvh_max_depth * (bvh_width - 1) + 2];
  int count_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
