#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// A tree over spheres, and the order in which its leaves want them.
struct Bvh {
  std::vector<BvhNode> nodes;        ///< the root first; none: the spheres are to be scanned
  std::vector<std::int32_t> slots;   ///< sphere of each slot, or no_primitive; leaf k: SphereView
  std::size_t scanned = 0;           ///< slots in front that are in no leaf
  AlignedArray<SphereBlock> blocks;  ///< sixteen slots each; only leaves are filled
};

/// Builds a tree of 16-wide nodes: binary splits by the surface area heuristic (split.h), collapsed
/// to the least sum of areas (binary_tree.h). Nodes and leaves lie in depth-first order. Every bit
/// of it is the same for any `parallel_for`. Kept apart, to be scanned, are spheres that no box can
/// hold and giants (spheres_apart.h). Where more copies of one sphere, same centre and same radius,
/// lie together than a leaf holds, only the two of the lowest ids are kept, and of those kept apart
/// likewise: no ray's hit depends on the others. Takes any spheres, max_primitives at most; the
/// depth is bounded by bvh_max_depth. Throws std::bad_alloc, and what `parallel_for` throws.
Bvh build_bvh(const std::vector<Sphere>& spheres, const ParallelFor& parallel_for = serial_for);

/// A block of slots that hold no sphere.
SphereBlock empty_block();

/// No tree: every sphere in the slot of its own id, all scanned. Throws std::bad_alloc.
Bvh no_bvh(std::size_t spheres);

}  // namespace boule
