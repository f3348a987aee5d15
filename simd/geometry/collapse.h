#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/binary_forest.h"
#include "simd/geometry/large_array.h"

namespace boule {

/// The nodes of a forest as nodes of sixteen children, by the shares of the binary nodes: the root
/// first, in depth-first order. The subtrees get their places one after the other, each once it is
/// built. Then threads can make the nodes of a subtree that has a place, and the subtree itself is
/// no longer needed.
class Collapse {
 public:
  /// Plans the upper part, twigs included, which has been weighed. `forest` must outlive the
  /// object.
  explicit Collapse(const BinaryForest& forest);

  /// The number of wide nodes in a subtree that is built: 0 in a twig and in a single leaf. (If
  /// that is all, the root has one child and belongs to the upper part.)
  [[nodiscard]] std::size_t count_nodes(std::size_t subtree) const;
  /// Gives the next subtree its place. Call it for each subtree, in order.
  void place_next(std::size_t nodes, std::size_t leaves);
  /// The number of nodes and of leaves so far, and so of all at the end.
  [[nodiscard]] std::size_t node_count() const { return node_count_; }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
  /// The index of the first leaf of a subtree that has its place.
  [[nodiscard]] std::size_t first_leaf(std::size_t subtree) const {
    return places_[subtree].first_leaf;
  }

  /// Makes the nodes of a subtree that has its place. Threads may make different subtrees in
  /// parallel.
  void make_subtree(std::size_t subtree, BvhNode* nodes) const;
  /// Makes the few nodes outside the subtrees. Precondition: all subtrees have their places, and
  /// the forest is finished.
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
