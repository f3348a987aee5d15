#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// The number of children of a node.
inline constexpr int bvh_width = 16;

/// The largest number of nodes on a path from the root to a leaf. The builder guarantees it, so the
/// stacks of the kernels are plain arrays.
inline constexpr int bvh_max_depth = 48;

/// The largest number of spheres in a leaf.
inline constexpr std::size_t bvh_leaf_size = 16;

/// A leaf: up to 16 spheres. Empty slots come last and have the radius NaN.
struct alignas(64) SphereBlock {
  float center_x[bvh_leaf_size], center_y[bvh_leaf_size], center_z[bvh_leaf_size];
  float radius[bvh_leaf_size];
};

/// The bit that marks a child as a leaf.
inline constexpr std::uint32_t leaf_bit = 0x80000000;

/// The boxes of up to 16 children, rounded outward, and the index of each child. If child[k] has
/// the leaf_bit, child k is the leaf index_of(child[k]) and holds leaf_size[k] spheres. Otherwise
/// it is the node child[k].
struct alignas(64) BvhNode {
  float min_x[bvh_width], min_y[bvh_width], min_z[bvh_width];
  float max_x[bvh_width], max_y[bvh_width], max_z[bvh_width];
  std::uint32_t child[bvh_width];
  std::uint8_t leaf_size[bvh_width];  ///< 0 for nodes
  std::uint8_t size;                  ///< number of children; the boxes from `size` on are empty
};

/// The index of a child: among the leaves if it has the leaf_bit, otherwise among the nodes.
constexpr std::uint32_t index_of(std::uint32_t child) { return child & ~leaf_bit; }

/// A bounding volume hierarchy over spheres. Its root is nodes[0]. Without nodes there is no tree:
/// kernels test all spheres.
struct BvhView {
  const BvhNode* nodes;
  std::size_t size;
  float extent;  ///< largest absolute coordinate of any box; without nodes, of any sphere
};

}  // namespace boule
