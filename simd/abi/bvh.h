#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// Children of a node.
inline constexpr int bvh_width = 16;

/// Nodes on any way from the root to a leaf, guaranteed by the builder: the kernels' stack is a
/// plain array.
inline constexpr int bvh_max_depth = 48;

/// Spheres in a leaf.
inline constexpr std::size_t bvh_leaf_size = 16;

/// A leaf: up to 16 spheres, the first ones; the others have the radius NaN.
struct alignas(64) SphereBlock {
  float center_x[bvh_leaf_size], center_y[bvh_leaf_size], center_z[bvh_leaf_size];
  float radius[bvh_leaf_size];
};

/// Marks a child that is a leaf.
inline constexpr std::uint32_t leaf_bit = 0x80000000;

/// The boxes of up to 16 children, rounded outward, and where the children are: child k is the leaf
/// index_of(child[k]), of leaf_size[k] spheres, if it has the leaf_bit, else the node child[k].
struct alignas(64) BvhNode {
  float min_x[bvh_width], min_y[bvh_width], min_z[bvh_width];
  float max_x[bvh_width], max_y[bvh_width], max_z[bvh_width];
  std::uint32_t child[bvh_width];
  std::uint8_t leaf_size[bvh_width];  ///< 0 for nodes
  std::uint8_t size;  ///< children that there are, the first ones; the others' boxes are empty
};

/// The number of a child among the leaves, or among the nodes.
constexpr std::uint32_t index_of(std::uint32_t child) { return child & ~leaf_bit; }

/// A tree over spheres; its root is nodes[0]. No nodes: no tree, everything is scanned.
struct BvhView {
  const BvhNode* nodes;
  std::size_t size;
  float extent;  ///< the greatest coordinate of any box, without its sign
};

}  // namespace boule
