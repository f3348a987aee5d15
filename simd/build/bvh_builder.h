#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"
#include "simd/build/aligned_array.h"

namespace boule {

/// A tree over spheres, and the order in which its leaves want them.
struct Bvh {
  std::vector<BvhNode> nodes;       ///< the root first; none: the spheres are to be scanned
  std::vector<std::int32_t> slots;  ///< sphere of each slot, or -1; those of leaf k: SphereView
  std::size_t scanned = 0;          ///< slots in front that are in no leaf
};

/// Builds a tree of 8-wide nodes by the surface area heuristic over binned centres (Wald, "On fast
/// Construction of SAH-based Bounding Volume Hierarchies", 2007), splitting the child of the
/// largest area first. Kept apart, to be scanned: spheres beyond filter::limit or not finite, and
/// up to 16 whose box is a good part of all (a ground sphere would be in everybody's way).
/// Takes any spheres; the depth is bounded by bvh_max_depth. Throws std::bad_alloc.
Bvh build_bvh(const std::vector<Sphere>& spheres);

/// No tree: every sphere in its own place, all scanned.
Bvh no_bvh(std::size_t spheres);

}  // namespace boule
