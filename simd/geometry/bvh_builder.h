#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"
#include "simd/geometry/large_array.h"
#include "simd/geometry/slot_materials.h"

namespace boule {

/// The id of a slot that holds no sphere: no ray's source, not even that of a ray that leaves
/// nothing, which is no_primitive.
inline constexpr std::int32_t empty_slot = no_primitive - 1;

/// Spheres in slots, and a tree over those that are in leaves.
struct Bvh {
  LargeArray<BvhNode> nodes;       ///< the root first; none: the spheres are to be scanned
  LargeArray<std::int32_t> slots;  ///< sphere of each slot, or empty_slot; leaf k: SphereView
  std::size_t scanned = 0;         ///< slots in front that are in no leaf
  LargeArray<SphereBlock> blocks;  ///< sixteen slots each
  SlotMaterials materials;
};

/// Where a tree belongs that is built.
struct TreePlace {
  int depth = 1;  ///< of its root: 1, or more if it hangs below other nodes
  /// False: all spheres are in leaves. Precondition: in_filter_range() takes them.
  bool keeps_apart = true;
};

/// Builds a tree of 16-wide nodes: binary splits by the surface area heuristic (split.h), collapsed
/// to the least sum of areas (binary_tree.h). Nodes and leaves lie in depth-first order. Every bit
/// of it is the same for any `parallel_for`. Kept apart, to be scanned, are spheres that no box can
/// hold and giants (spheres_apart.h). Where more copies of one sphere, same centre and same radius,
/// lie together than a leaf holds, only the two of the lowest ids are kept, and of those kept apart
/// likewise: no ray's hit depends on the others. Takes any spheres, max_primitives at most; the
/// depth is bounded by bvh_max_depth.
///
/// The spheres' memory is given back while the tree takes their place, so that both together need
/// little more than the tree: 26 bytes a sphere, and 5 more where they are not all made of the
/// same. Throws std::bad_alloc, and what `parallel_for` throws; the spheres are lost then.
Bvh build_bvh(std::vector<Sphere> spheres, const ParallelFor& parallel_for = serial_for,
              const TreePlace& place = {});

/// A block of slots that hold no sphere.
SphereBlock empty_block();

/// No tree: every sphere in the slot of its own id, all scanned. Throws std::bad_alloc.
Bvh no_bvh(const std::vector<Sphere>& spheres);

}  // namespace boule
