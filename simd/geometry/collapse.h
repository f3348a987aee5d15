#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/binary_forest.h"
#include "simd/geometry/large_array.h"

namespace boule {

/// The nodes of a forest as nodes of sixteen children, as the shares of its nodes say: the root
/// first, in depth-first order. The subtrees get their places one after the other, each once it was
/// built. Then threads can make the nodes of those that have a place, and none is needed after
/// that.
class Collapse {
 public:
  /// Plans the upper part, twigs included, which was weighed. `forest` must outlive it.
  explicit Collapse(const BinaryForest& forest);

  /// How many wide nodes are within a subtree that was built: none in a twig, and in a single leaf.
  /// (Where that is all, the root has one child and belongs to the upper part.)
  [[nodiscard]] std::size_t count_nodes(std::size_t subtree) const;
  /// Gives the next subtree its place. To be called for each of them, in their order.
  void place_next(std::size_t nodes, std::size_t leaves);
  /// The nodes and the leaves so far, and so all of them at the end.
  [[nodiscard]] std::size_t node_count() const { return node_count_; }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
  /// Where the leaves of a subtree begin that has its place.
  [[nodiscard]] std::size_t first_leaf(std::size_t subtree) const {
    return places_[subtree].first_leaf;
  }

  /// Makes the nodes of a subtree that has its place. Threads may make those of different ones.
  void make_subtree(std::size_t subtree, BvhNode* nodes) const;
  /// Makes the nodes that belong to no subtree, few. Precondition: all subtrees have their places,
  /// and the forest is finished.
  void make_upper(BvhNode* nodes) const;

 private:
  /// The first of a subtree's nodes and leaves.
  struct Place {
    std::size_t first_node, first_leaf;
  };
  /// A node of the upper part that becomes a wide one, and the subtree that comes next.
  struct UpperPart {
    ForestNode at;
    std::uint32_t next_subtree;
  };

  void plan(ForestNode at, std::uint32_t& next_subtree);
  void place_upper(std::size_t next_subtree);

  const BinaryForest& forest_;
  std::vector<UpperPart> upper_;           ///< in depth-first order
  std::vector<std::size_t> upper_places_;  ///< so far
  std::vector<Place> places_;              ///< by subtree, so far
  std::size_t node_count_ = 0, leaf_count_ = 0;
};

}  // namespace boule
