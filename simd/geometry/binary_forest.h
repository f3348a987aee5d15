#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "simd/geometry/binary_tree.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/split.h"

namespace boule {

/// A node of a forest: the node with index `node` of subtree `tree`, or of the upper part.
struct ForestNode {
  static constexpr std::uint32_t upper = ~std::uint32_t{0};
  std::uint32_t tree, node;
};

/// A binary tree in parts that threads can build at once. The upper part is divided level by level,
/// by all threads together; below it hang subtrees, each built by one thread. How a run is divided
/// depends on the spheres alone, so that the tree is the same for any number of threads.
class BinaryForest {
 public:
  /// Builds the tree over the spheres, at least one. They are brought into the order of the leaves,
  /// where they are. They must outlive it. `depth` is that of the root.
  BinaryForest(std::span<BuildSphere> spheres, const ParallelFor& parallel_for, int depth = 1);

  /// Spheres that became a tree of their own: run [begin, end).
  struct Subtree {
    std::size_t begin, end;
    int depth;
    std::uint32_t first_leaf = 0;
    BinaryTree tree = {};
  };
  [[nodiscard]] const std::vector<Subtree>& subtrees() const { return subtrees_; }
  /// The subtrees in the order of their spheres, and so of their leaves.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] std::size_t leaves() const { return leaves_; }
  [[nodiscard]] std::span<const BuildSphere> spheres_of(const Subtree& subtree) const {
    return spheres_.subspan(subtree.begin, subtree.end - subtree.begin);
  }
  /// Forgets the nodes of a subtree, and gives their memory back. Of different subtrees, threads
  /// may do so at the same time.
  void drop(std::uint32_t subtree);

  [[nodiscard]] ForestNode root() const { return root_; }
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
  };
  struct Level;

  void attach(const Run& run, ForestNode node);
  void add_subtree(const Run& run);
  std::vector<Run> divide(const std::vector<Run>& runs, const ParallelFor& parallel_for);
  void add_children(std::vector<Run>& next, const Run& run, std::size_t middle);
  void build(Subtree& subtree);
  void finish_upper();

  std::span<BuildSphere> spheres_;
  std::size_t subtree_size_;
  std::vector<UpperNode> upper_;
  std::vector<Subtree> subtrees_;
  std::vector<std::uint32_t> order_;
  ForestNode root_{};
  std::size_t leaves_ = 0;
};

}  // namespace boule
