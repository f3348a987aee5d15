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

/// A binary tree in parts that threads can build in parallel. All threads together divide the upper
/// part level by level; below it hang subtrees, each built by one thread. The division of a run
/// depends on the spheres alone, so the tree is the same for any number of threads. The choice of
/// wide nodes is made for the upper part and for each subtree by itself, so only some subtrees need
/// be in memory at a time. Small subtrees, the twigs, count to the upper part: alone they would
/// become wide nodes that are nearly empty.
class BinaryForest {
 public:
  /// Divides the spheres, at least one, into the runs of subtrees, and reorders them in place to
  /// match. They must outlive the forest. `depth` is that of the root.
  BinaryForest(std::span<BuildSphere> spheres, const ParallelFor& parallel_for, int depth = 1);

  /// Spheres that become a tree of their own: run [begin, end).
  struct Subtree {
    std::size_t begin, end;
    int depth;
    BinaryNode root = {};  ///< set by build(); of a leaf it is the whole tree
    BinaryTree tree = {};
  };
  /// In the order of their spheres, and so of their leaves.
  [[nodiscard]] const std::vector<Subtree>& subtrees() const { return subtrees_; }
  [[nodiscard]] std::span<const BuildSphere> spheres_of(const Subtree& subtree) const {
    return spheres_.subspan(subtree.begin, subtree.end - subtree.begin);
  }

  /// Builds a subtree, and reorders its spheres to match its leaves. With `ids`, these become the
  /// ids of its spheres in the order before, and the spheres hold indices into them. Threads may
  /// call this and drop() for different subtrees in parallel.
  void build(std::size_t subtree, std::vector<std::int32_t>* ids = nullptr);
  /// Whether a subtree is a twig, which is kept until finish().
  [[nodiscard]] bool is_twig(std::size_t subtree) const;
  /// Chooses the wide nodes of the upper part. Precondition: the twigs are built.
  void weigh();
  /// Forgets the nodes of a subtree except its root, and leaves their memory to later subtrees.
  void drop(std::size_t subtree);
  /// Makes the boxes of the upper nodes exact; until then they serve only for weighing.
  /// Precondition: all subtrees are built.
  void finish();

  [[nodiscard]] ForestNode root() const { return root_; }
  /// Whether a node has children that can be asked for: it counts to the upper part and is not a
  /// leaf. `node` is an upper node, a node of a twig, or the root of another subtree.
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
