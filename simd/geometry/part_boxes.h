#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simd/abi/bvh.h"
#include "simd/abi/geometry.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// The box of a part as placed in the scene, outward like those of a tree: it holds the boxes of
/// its tree's root (filter::moved_box) and its spheres outside the leaves.
BuildBox box_of(const PartView& part);

/// A tree over boxes, at least one: nodes of sixteen children, the root first. Its leaves, of size
/// 1, are the indices of the boxes.
std::vector<BvhNode> build_box_tree(std::span<const BuildBox> boxes);

}  // namespace boule
