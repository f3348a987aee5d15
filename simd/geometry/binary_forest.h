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

/// The spheres of a tree, in two arrays, because a partition reads one and writes the other. Each
/// run of spheres is in one of them; whoever works on a run knows in which (its side, 0 or 1).
struct SphereBuffers {
  explicit SphereBuffers(std::size_t count)
      : size(count),
        arrays{std::make_unique_for_overwrite<BuildSphere[]>(count),
               std::make_unique_for_overwrite<BuildSphere[]>(count)} {}

  [[nodiscard]] std::span<BuildSphere> run(int side, std::size_t begin, std::size_t end) const {
    return {arrays[side].get() + begin, end - begin};
  }

  std::size_t size;
  std::unique_ptr<BuildSphere[]> arrays[2];
};

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
  /// Builds the tree over the first arrays of `buffers`, at least one sphere.
  BinaryForest(SphereBuffers& buffers, const ParallelFor& parallel_for);

  /// Spheres that became a tree of their own: run [begin, end) of side `side`.
  struct Subtree {
    std::size_t begin, end;
    int side, depth;
    std::uint32_t first_leaf = 0;
    BinaryTree tree = {};
  };
  [[nodiscard]] const std::vector<Subtree>& subtrees() const { return subtrees_; }
  [[nodiscard]] std::uint32_t leaves() const { return leaves_; }

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
  void add_subtree(const Run& run, int side);
  std::vector<Run> divide(const std::vector<Run>& runs, int side, const ParallelFor& parallel_for);
  void add_children(std::vector<Run>& next, const Run& run, std::size_t middle, int side);
  void finish_upper();

  SphereBuffers& buffers_;
  std::size_t subtree_size_;
  std::vector<UpperNode> upper_;
  std::vector<Subtree> subtrees_;
  ForestNode root_{};
  std::uint32_t leaves_ = 0;
};

}  // namespace boule
