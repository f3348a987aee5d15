#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// The number of exact copies of one sphere that are kept. Two are enough for any ray's hit: equal
/// hits go to the lowest id, and a ray that leaves that sphere hits the next.
inline constexpr int kept_copies = 2;

/// A node of the binary tree, for the collapse into wide nodes. It is small, because the whole
/// binary tree is in memory together with the spheres.
class BinaryNode {
 public:
  std::uint32_t right = 0;  ///< the second child; the first follows this node. Of a leaf: its index
  std::uint32_t size = 0;   ///< number of spheres of a leaf; 0 for inner nodes

  /// Rounded outward.
  [[nodiscard]] BuildBox box() const {
    return {Float4{low_[0], low_[1], low_[2], 0}, Float4{high_[0], high_[1], high_[2], 0}};
  }
  void set_box(const BuildBox& box) {
    for (int k = 0; k < 3; ++k) {
      low_[k] = box.low[k];
      high_[k] = box.high[k];
    }
  }
  /// The share of the first child if an inner node becomes j children of a wide node, j = 1 .. 16;
  /// the second child becomes the rest. 0: the node stays whole, as one child.
  [[nodiscard]] int share(int j) const {
    return j < 2 ? 0 : static_cast<int>(numbers_ >> 4 * (j - 2) & 15);
  }
  /// Sets a share. Precondition: none was set for this j before, and 2 <= j, 1 <= share < j.
  void set_share(int j, int share) { numbers_ |= static_cast<std::uint64_t>(share) << 4 * (j - 2); }
  /// The number of spheres behind those of a leaf in the run that were left out of the leaves:
  /// exact copies of them.
  [[nodiscard]] std::uint64_t copies() const { return numbers_; }
  void set_copies(std::uint64_t copies) { numbers_ = copies; }

 private:
  float low_[3] = {}, high_[3] = {};
  std::uint64_t numbers_ = 0;  ///< of a leaf the number of copies, otherwise the shares, four bits
                               ///< each
};
static_assert(sizeof(BinaryNode) == 40);

/// The cost of a binary node with its descendants if it becomes at most j children of a wide node,
/// j = 1 .. 16: the sum of the areas of all wide nodes. Leaves are left out, because every tree of
/// wide nodes has the same ones.
using CollapseCosts = std::array<double, bvh_width + 1>;

/// The lowest costs of a node, from those of its children. Sets the node's shares to the choice
/// that gives them and reads its box. Dynamic programming (Ylitie, Karras, Laine, "Efficient
/// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017).
CollapseCosts choose_shares(BinaryNode& node, const CollapseCosts& left,
                            const CollapseCosts& right);

/// A binary tree over a run of spheres, in depth-first order: the root first. From the first leaf
/// to the last, the leaves' spheres follow each other in the run.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::uint32_t leaves = 0;
  CollapseCosts costs{};  ///< of the root
};

/// The number of inner nodes between the root and a leaf if every node halves its spheres.
int halving_levels(std::size_t spheres);

/// Builds the tree whose root lies at `depth`: by split(), and by halve() where more splits might
/// exceed bvh_max_depth. Reorders the spheres; `scratch` has room for as many. If there are `ids`,
/// the spheres hold indices into them in place of their own.
BinaryTree build_binary_tree(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch,
                             int depth, std::span<const std::int32_t> ids = {});

}  // namespace boule
