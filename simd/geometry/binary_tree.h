#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// So many exact copies of one sphere are kept. Any ray's hit is then the one that it has with all
/// copies: equal hits go to the lowest id, and a ray that leaves this one meets the next.
inline constexpr int kept_copies = 2;

/// A node of the binary tree that becomes a wide one.
struct BinaryNode {
  BuildBox box;         ///< rounded outward
  std::uint32_t right;  ///< the second child; the first follows this node. Of a leaf: its index
  std::uint32_t size;   ///< spheres of a leaf; 0: no leaf
  /// Spheres that follow those of a leaf in the run and are in no leaf: exact copies of them.
  std::uint32_t copies = 0;
  /// share[j]: if this node may become j children of a wide node, its first child becomes so many
  /// of them and the second one the rest; 0: the node stays whole, as one child.
  std::uint8_t share[bvh_width + 1];
};

/// What a binary node and those below it cost if it becomes at most j children of a wide node, j =
/// 1 .. 16: the sum of the areas of all wide nodes. Leaves are not counted, because every tree of
/// wide nodes has the same ones.
using CollapseCosts = std::array<double, bvh_width + 1>;

/// The least costs of a node, from those of its children; sets `node.share` to the choice that
/// gives them and reads `node.box`. Dynamic programming (Ylitie, Karras, Laine, "Efficient
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

/// Inner nodes between the root and a leaf where every node halves its spheres.
int halving_levels(std::size_t spheres);

/// Builds the tree whose root lies at `depth`: by split(), but by halve() where more splits might
/// lead below bvh_max_depth. Reorders the spheres; `scratch` has room for as many.
BinaryTree build_binary_tree(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch,
                             int depth);

}  // namespace boule
