#include "simd/geometry/bvh_builder.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/math/ray.h"
#include "simd/abi/isa.h"
#include "simd/geometry/binary_forest.h"
#include "simd/geometry/collapse.h"
#include "simd/geometry/spheres_apart.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

/// Writes the leaves of one subtree.
void fill_leaves(Bvh& bvh, const std::vector<Sphere>& spheres, const SphereBuffers& buffers,
                 const BinaryForest::Subtree& subtree) {
  const BuildSphere* from = buffers.run(subtree.side, subtree.begin, subtree.end).data();
  std::size_t leaf = subtree.first_leaf;
  for (const BinaryNode& node : subtree.tree.nodes) {
    if (node.size == 0) continue;
    SphereBlock& block = bvh.blocks[bvh.scanned / bvh_leaf_size + leaf];
    for (std::size_t k = 0; k < node.size; ++k, ++from) {
      bvh.slots[bvh.scanned + leaf * bvh_leaf_size + k] = from->id;
      block.center_x[k] = from->at[0];
      block.center_y[k] = from->at[1];
      block.center_z[k] = from->at[2];
      block.radius[k] = spheres[static_cast<std::size_t>(from->id)].radius;
    }
    from += node.copies;
    ++leaf;
  }
}

}  // namespace

SphereBlock empty_block() {
  SphereBlock block{};
  std::fill_n(block.radius, bvh_leaf_size, std::numeric_limits<float>::quiet_NaN());
  return block;
}

Bvh build_bvh(const std::vector<Sphere>& spheres, const ParallelFor& parallel_for) {
  Bvh bvh;
  const std::vector<std::int32_t> apart = find_spheres_apart(spheres, parallel_for);
  bvh.slots = without_copies(apart, spheres);
  bvh.scanned = padded(bvh.slots.size());
  if (apart.size() == spheres.size()) {
    bvh.slots.resize(bvh.scanned, no_primitive);
    return bvh;
  }
  SphereBuffers buffers(spheres.size() - apart.size());
  gather_others(spheres, apart, buffers.arrays[0].get(), parallel_for);
  const BinaryForest forest(buffers, parallel_for);
  bvh.nodes = collapse(forest);
  bvh.slots.resize(bvh.scanned + forest.leaves() * bvh_leaf_size, no_primitive);
  bvh.blocks.resize(bvh.slots.size() / bvh_leaf_size, empty_block());
  const bool few = buffers.size <= tuning::chunk_size;
  const ParallelFor leaf_for = few ? serial_for : parallel_for;
  leaf_for(forest.subtrees().size(),
           [&](std::size_t i) { fill_leaves(bvh, spheres, buffers, forest.subtrees()[i]); });
  return bvh;
}

Bvh no_bvh(std::size_t spheres) {
  Bvh bvh;
  bvh.slots.resize(spheres);
  std::iota(bvh.slots.begin(), bvh.slots.end(), 0);
  bvh.scanned = spheres;
  return bvh;
}

}  // namespace boule
