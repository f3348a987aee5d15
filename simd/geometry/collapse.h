#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "simd/abi/bvh.h"
#include "simd/geometry/binary_forest.h"

namespace boule {

/// The nodes of a forest as nodes of sixteen children, as the shares of its nodes say: the root
/// first, in depth-first order. It is planned as a whole, and then made subtree by subtree, so that
/// threads can share it and no subtree is needed once its nodes are made.
class Collapse {
 public:
  /// Plans it. `forest` must outlive it.
  Collapse(const BinaryForest& forest, const ParallelFor& parallel_for);

  /// How many nodes there will be.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// A node and where it belongs.
  struct PlacedNode {
    std::size_t index;
    BvhNode node;
  };
  /// The nodes that belong to no subtree, few. To be made before any of these is dropped.
  [[nodiscard]] std::vector<PlacedNode> make_upper() const;
  /// Makes the nodes that lie within a subtree. Threads may make those of different ones.
  void make_subtree(std::uint32_t subtree, BvhNode* nodes) const;

 private:
  /// The wide node that is made of `at`. Of one within a subtree also all nodes below it.
  struct Part {
    ForestNode at;
    std::size_t first = 0, count = 1;  ///< of its nodes
  };
  /// The parts that lie in one subtree: they follow each other.
  struct Parts {
    std::size_t begin = 0, end = 0;
  };

  void plan(ForestNode at);
  void make_upper(ForestNode at, std::size_t& part, std::vector<PlacedNode>& nodes) const;

  const BinaryForest& forest_;
  std::vector<Part> parts_;  ///< in depth-first order
  std::vector<Parts> of_subtrees_;
  std::size_t size_ = 0;
};

}  // namespace boule
