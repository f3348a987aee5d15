#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "simd/geometry/binary_tree.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/scratch_rooms.h"
#include "simd/geometry/split.h"

namespace boule {

/// A node of a forest: the node with index `node` of the upper part, or of a subtree.
struct ForestNode {
  static constexpr std::uint32_t upper = ~std::uint32_t{0};
  std::uint32_t tree, node;

  [[nodiscard]] bool is_upper() const { return tree == upper; }
  friend bool operator==(const ForestNode&, const ForestNode&) = default;
};

/// A binary tree in parts that threads can build at once. The upper part is divided level by level,
/// by all threads together; below it hang subtrees, each built by one thread. How a run is divided
/// depends on the spheres alone, so that the tree is the same for any number of threads. Which
/// nodes become wide ones is decided for the upper part and for each subtree by itself, so that
/// not all subtrees need be in memory at the same time. Small subtrees, the twigs, count to the
/// upper part: alone they would become wide nodes that are nearly empty.
class BinaryForest {
 public:
  /// Divides the spheres, at least one, into the runs of subtrees, and brings them into the order
  /// of these, where they are. They must outlive the forest. `depth`
  /// is that of the root.
  BinaryForest(std::span<BuildSphere> spheres, const ParallelFor& parallel_for, int depth = 1);

  /// Spheres that become a tree of their own: run [begin, end).
  struct Subtree {
    std::size_t begin, end;
    int depth;
    BinaryNode root = {};  ///< once it was built; of a leaf it is the whole tree
    BinaryTree tree = {};
  };
  /// In the order of their spheres, and so of their leaves.
  [[nodiscard]] const std::vector<Subtree>& subtrees() const { return subtrees_; }
  [[nodiscard]] std::span<const BuildSphere> spheres_of(const Subtree& subtree) const {
    return spheres_.subspan(subtree.begin, subtree.end - subtree.begin);
  }

  /// Builds a subtree, and brings its spheres into the order of its leaves. With `ids`, these
  /// become the ids of its spheres in the order they had before, and the spheres hold indices in
  /// that. This and drop() threads may call for different ones at the same time.
  void build(std::size_t subtree, std::vector<std::int32_t>* ids = nullptr);
  /// Whether a subtree is a twig, and so to be kept until finish().
  [[nodiscard]] bool is_twig(std::size_t subtree) const;
  /// Decides which nodes of the upper part become wide ones. Precondition: the twigs were built.
  void weigh();
  /// Forgets the nodes of a subtree but for its root, and leaves their memory to the next ones.
  void drop(std::size_t subtree);
  /// Makes the boxes of the upper nodes exact: until then they are good enough to weigh only.
  /// Precondition: all subtrees were built.
  void finish();

  [[nodiscard]] ForestNode root() const { return root_; }
  /// Whether a node, which is that of a twig or the root of a subtree if it is none of the upper
  /// ones, can be asked for its children: it counts to the upper part and is no leaf.
  [[nodiscard]] bool is_open(ForestNode node) const {
    return node.is_upper() || ((*this)[node].size == 0 && is_twig(node.tree));
  }
  [[nodiscard]] const BinaryNode& operator[](ForestNode node) const;
  [[nodiscard]] ForestNode left(ForestNode node) const;
  [[nodiscard]] ForestNode right(ForestNode node) const;

 private:
  struct UpperNode {
    BinaryNode node = {};
    ForestNode left = {}, right = {};
  };
  /// Spheres that hang below an upper node, or are the whole tree.
  struct Run {
    std::size_t begin, end;
    int depth;
    std::uint32_t parent;
    bool is_right;
    BuildBox extent = {};  ///< of centres and radii
  };
  struct Level;

  void attach(const Run& run, ForestNode node);
  void add_subtree(const Run& run);
  std::vector<Run> divide(const std::vector<Run>& runs, const ParallelFor& parallel_for);
  void add_children(std::vector<Run>& next, const Level& level, std::size_t run);
  void sort_subtrees();

  std::span<BuildSphere> spheres_;
  std::size_t subtree_size_;
  ScratchRooms rooms_;
  std::vector<UpperNode> upper_;
  std::vector<Subtree> subtrees_;
  ForestNode root_{};
};

}  // namespace boule
