#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// Of exact copies of a sphere, as many are kept as any ray can tell apart: one that leaves the
/// first may meet the second. With these two every ray's hit is the one that it has with all.
inline constexpr int kept_copies = 2;

/// A node of the binary tree that becomes a wide one.
struct BinaryNode {
  BuildBox box;         ///< rounded outward
  std::uint32_t right;  ///< the second child; the first follows this node. Of a leaf: its number
  std::uint32_t size;   ///< spheres of a leaf; 0: no leaf
  /// Spheres of the run behind those of a leaf, left out: exact copies of those in it.
  std::uint32_t copies = 0;
  /// Of j places in the wide node, the first child's; 0: it takes one itself.
  std::uint8_t take[bvh_width + 1];
};

/// What a binary node and those under it cost if it takes j places in a wide node, j = 1 .. 16: the
/// sum of the areas of the wide nodes. Leaves cost the same in every tree of wide nodes, and use up
/// places that nobody needs. More places never cost more: all are given away.
using CollapseCosts = std::array<double, bvh_width + 1>;

/// The least costs of a node, from its children's, and the choice that gives them: dynamic
/// programming (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through
/// Compressed Wide BVHs", 2017). `node.box` must be there.
CollapseCosts choose_places(BinaryNode& node, const CollapseCosts& left,
                            const CollapseCosts& right);

/// A binary tree over a run of spheres, in depth-first order: the root first, leaves from left to
/// right over the spheres as they then lie.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::uint32_t leaves = 0;
  CollapseCosts costs{};  ///< of the root
};

/// Inner nodes on any way through a binary tree of so many spheres that is only halved.
int halving_levels(std::size_t spheres);

/// Builds the tree whose root lies at `depth`, by splits; by halves where bvh_max_depth levels
/// would not do otherwise. Reorders the spheres; `scratch` has as much room.
BinaryTree build_binary_tree(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch,
                             int depth);

}  // namespace boule
