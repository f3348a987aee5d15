#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// Children of a node.
inline constexpr int bvh_width = 16;

/// The most nodes on a way from the root to a leaf. The builder guarantees it, so that the kernels'
/// stacks are plain arrays.
inline constexpr int bvh_max_depth = 48;

/// Spheres in a leaf, at most.
inline constexpr std::size_t bvh_leaf_size = 16;

/// A leaf: up to 16 spheres. Empty slots come last and have the radius NaN.
struct alignas(64) SphereBlock {
  float center_x[bvh_leaf_size], center_y[bvh_leaf_size], center_z[bvh_leaf_size];
  float radius[bvh_leaf_size];
};

/// Marks a child that is a leaf.
inline constexpr std::uint32_t leaf_bit = 0x80000000;

/// The boxes of up to 16 children, rounded outward, and which nodes or leaves the children are:
/// with the leaf_bit, child k is the leaf index_of(child[k]), of leaf_size[k] spheres; else it is
/// the node child[k].
struct alignas(64) BvhNode {
  float min_x[bvh_width], min_y[bvh_width], min_z[bvh_width];
  float max_x[bvh_width], max_y[bvh_width], max_z[bvh_width];
  std::uint32_t child[bvh_width];
  std::uint8_t leaf_size[bvh_width];  ///< 0 for nodes
  std::uint8_t size;                  ///< of the children; those from `size` on have empty boxes
};

/// The index of a child among the leaves, or among the nodes.
constexpr std::uint32_t index_of(std::uint32_t child) { return child & ~leaf_bit; }

/// A tree over spheres; its root is nodes[0]. Without nodes there is no tree, and all spheres are
/// scanned.
struct BvhView {
  const BvhNode* nodes;
  std::size_t size;
  float extent;  ///< the greatest absolute coordinate of any box; without nodes, of any sphere
};

}  // namespace boule
