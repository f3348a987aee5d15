#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/tuning.h"
#include "simd/lanes/lanes.h"

/// The addresses of a tree's nodes and leaves in memory, for bundles, sets and flights, which
/// prefetch them into the cache.
namespace boule::BOULE_KERNEL_ISA {

/// The slot of a leaf's first sphere.
BOULE_INLINE std::uint32_t slot_of(const SphereView& spheres, const SphereBlock& leaf) {
  return static_cast<std::uint32_t>(&leaf - spheres.blocks) *
         static_cast<std::uint32_t>(bvh_leaf_size);
}

/// Finds the node or the leaf of a child, without a branch: which of the two it is, is
/// unpredictable.
class TreeBlocks {
 public:
  BOULE_INLINE explicit TreeBlocks(const GeometryView& geometry)
      : first_{as_bytes(geometry.bvh.nodes),
               as_bytes(geometry.spheres.blocks + geometry.spheres.scanned / bvh_leaf_size)},
        ids_{first_[0], as_bytes(geometry.spheres.id + geometry.spheres.scanned)},
        is_far_(geometry.spheres.block_count > tuning::most_near_blocks) {}

  /// Whether the tree exceeds the near caches.
  [[nodiscard]] BOULE_INLINE bool is_far() const { return is_far_; }
  /// The node or the leaf of a child.
  BOULE_INLINE const void* at(std::uint32_t child) const {
    const std::size_t leaf = child >> 31;
    static_assert(leaf_bit == 1U << 31 && sizeof(BvhNode) == 512 && sizeof(SphereBlock) == 256);
    return first_[leaf] + (std::size_t{index_of(child)} << (9 - leaf));
  }
  /// The node or the leaf of a child. In a far tree, also prefetches the data of its visit.
  BOULE_INLINE const void* fetch(std::uint32_t child) const {
    const std::size_t leaf = child >> 31, index = index_of(child);
    const auto* const block = static_cast<const char*>(at(child));
    if (!is_far_) return block;
    prefetch(block);
    prefetch(block + (256 - 256 * leaf));
    static_assert(bvh_leaf_size * sizeof(std::int32_t) == 64);
    __builtin_prefetch(ids_[leaf] + (index << (9 - 3 * leaf)));
    return block;
  }

 private:
  template <class T>
  BOULE_INLINE static const char* as_bytes(const T* p) {
    return reinterpret_cast<const char*>(p);
  }
  /// Prefetches 256 bytes.
  BOULE_INLINE static void prefetch(const char* begin) {
    __builtin_prefetch(begin);
    __builtin_prefetch(begin + 64);
    __builtin_prefetch(begin + 128);
    __builtin_prefetch(begin + 192);
  }

  const char* first_[2];  ///< the first node, and the first leaf
  const char* ids_[2];  ///< the first leaf's ids; for nodes, which have none, the first node again
  bool is_far_;
};

/// The tree of a geometry without parts. PartTree (parts.h) is another.
class WholeTree {
 public:
  BOULE_INLINE explicit WholeTree(const GeometryView& geometry)
      : spheres_(geometry.spheres), nodes_(geometry.bvh.nodes), blocks_(geometry) {}

  [[nodiscard]] BOULE_INLINE const BvhNode& node(std::uint32_t child) const {
    return nodes_[child];
  }
  [[nodiscard]] BOULE_INLINE LeafRef leaf(std::uint32_t child) const {
    const std::size_t index = index_of(child), slot = spheres_.scanned + index * bvh_leaf_size;
    return {spheres_.blocks[spheres_.scanned / bvh_leaf_size + index], spheres_.id + slot, slot};
  }
  /// Prefetches the data of a visit of the child, if the tree is far.
  BOULE_INLINE void fetch(std::uint32_t child) const { blocks_.fetch(child); }

 private:
  const SphereView& spheres_;
  const BvhNode* nodes_;
  TreeBlocks blocks_;
};

}  // namespace boule::BOULE_KERNEL_ISA
