#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/bvh.h"

namespace boule {

/// Up to 16 capsules: the ends of their segments, and their radii. Empty slots come last and have
/// the radius NaN.
struct alignas(64) CapsuleBlock {
  float a_x[bvh_leaf_size], a_y[bvh_leaf_size], a_z[bvh_leaf_size];
  float b_x[bvh_leaf_size], b_y[bvh_leaf_size], b_z[bvh_leaf_size];
  float radius[bvh_leaf_size];
};

/// Capsules in slots, in blocks of sixteen, under a tree of their own. Kernels test the first
/// `scanned` slots, whole blocks, against every ray: those that boxes cannot hold. The leaves of
/// the tree follow: leaf k is block scanned / 16 + k. Capsules are searched after all other
/// primitives, and their ids follow those of the others.
struct CapsuleView {
  const CapsuleBlock* blocks;
  const std::int32_t* id;  ///< by slot; of empty slots negative
  std::size_t scanned;     ///< number of slots outside the leaves
  std::size_t slots;       ///< number of slots in all blocks; 0: there are no capsules
  BvhView bvh;             ///< without nodes all capsules are scanned
  std::int32_t first_id;   ///< the ids of capsules are first_id and higher
};

}  // namespace boule
