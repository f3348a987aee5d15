#pragma once

#include <cstddef>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// The box of a node's child k.
inline BuildBox child_box(const BvhNode& node, std::size_t k) {
  return {Float4{node.min_x[k], node.min_y[k], node.min_z[k], 0},
          Float4{node.max_x[k], node.max_y[k], node.max_z[k], 0}};
}

inline void set_child_box(BvhNode& node, std::size_t k, const BuildBox& box) {
  node.min_x[k] = box.low[0];
  node.min_y[k] = box.low[1];
  node.min_z[k] = box.low[2];
  node.max_x[k] = box.high[0];
  node.max_y[k] = box.high[1];
  node.max_z[k] = box.high[2];
}

/// A node without children.
inline BvhNode empty_node() {
  BvhNode node{};
  for (std::size_t k = 0; k < bvh_width; ++k) set_child_box(node, k, {});
  return node;
}

}  // namespace boule
