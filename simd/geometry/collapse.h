#pragma once

#include <vector>

#include "simd/abi/bvh.h"
#include "simd/geometry/binary_forest.h"

namespace boule {

/// The 16-wide nodes of a binary tree, the root first, in depth-first order. Which binary nodes
/// become children of one wide node was chosen when the binary tree was built (choose_shares() in
/// binary_tree.h).
std::vector<BvhNode> collapse(const BinaryForest& forest);

}  // namespace boule
