#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"
#include "simd/geometry/large_array.h"
#include "simd/geometry/slot_materials.h"

namespace boule {

/// The id of an empty slot. It differs from the source of every ray, including no_primitive, the
/// source of a ray that leaves nothing.
inline constexpr std::int32_t empty_slot = no_primitive - 1;

/// A sphere that was left out: an exact copy of two that were kept, those with the lowest ids.
struct SphereCopy {
  std::int32_t first, second;  ///< ids of the kept ones, in order
  std::int32_t id;

  friend bool operator<(const SphereCopy& a, const SphereCopy& b) {
    return std::tie(a.first, a.id) < std::tie(b.first, b.id);
  }
};

/// Spheres in slots, and a tree over those in leaves.
struct Bvh {
  LargeArray<BvhNode> nodes;       ///< the root first; empty: kernels scan the spheres
  LargeArray<std::int32_t> slots;  ///< id of the sphere in each slot, or empty_slot; leaf k: as in
                                   ///< SphereView
  std::size_t scanned = 0;         ///< number of slots outside the leaves, which come first
  LargeArray<SphereBlock> blocks;  ///< sixteen slots each
  SlotMaterials materials;
  std::vector<SphereCopy> copies;  ///< in order; unknown of a tree from a packed scene
};

/// The place of the tree to build.
struct TreePlace {
  int depth = 1;  ///< depth of its root: 1, or more if it hangs below other nodes
  /// False: all spheres are in leaves. Precondition: in_filter_range() accepts them.
  bool keeps_apart = true;
};

/// Builds a tree of 16-wide nodes: binary splits by the surface area heuristic (split.h), collapsed
/// to the least sum of areas (binary_tree.h). Nodes and leaves lie in depth-first order. Every bit
/// of the tree is the same for any `parallel_for`. Spheres that no box can hold, and giants
/// (spheres_apart.h), stay outside the tree and are scanned. Where more copies of one sphere, with
/// the same centre and radius, lie together than a leaf holds, only the two with the lowest ids are
/// kept, and likewise outside the tree: every ray's hit stays the same. `copies` has the others.
/// Takes any spheres, at most max_primitives; bvh_max_depth bounds the depth.
///
/// The spheres' memory is given back while the tree takes their place, so both together need little
/// more than the tree: 26 bytes a sphere, and 5 more if the materials differ. Throws
/// std::bad_alloc, and the exceptions of `parallel_for`; the spheres are lost then.
Bvh build_bvh(std::vector<Sphere> spheres, const ParallelFor& parallel_for = serial_for,
              const TreePlace& place = {});

/// A block of empty slots.
SphereBlock empty_block();

/// Spheres without a tree: every sphere in the slot of its own id, all scanned. Throws
/// std::bad_alloc.
Bvh no_bvh(const std::vector<Sphere>& spheres);

}  // namespace boule
