#include "simd/geometry/bvh_builder.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "simd/abi/isa.h"
#include "simd/geometry/binary_forest.h"
#include "simd/geometry/collapse.h"
#include "simd/geometry/spheres_apart.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

void set_sphere(SphereBlock& block, std::size_t k, const float (&at)[4]) {
  block.center_x[k] = at[0];
  block.center_y[k] = at[1];
  block.center_z[k] = at[2];
  block.radius[k] = at[3];
}

/// Whether all spheres are made of the same.
bool are_alike(const std::vector<Sphere>& spheres, const ParallelFor& parallel_for) {
  constexpr std::size_t chunk = 16 * tuning::chunk_size;
  std::atomic<bool> alike{true};
  parallel_for((spheres.size() + chunk - 1) / chunk, [&](std::size_t i) {
    const auto first = spheres.begin() + static_cast<std::ptrdiff_t>(i * chunk);
    const auto size = std::min(chunk, spheres.size() - i * chunk);
    const auto differs = [&](const Sphere& s) { return !(s.material == spheres[0].material); };
    if (std::any_of(first, first + static_cast<std::ptrdiff_t>(size), differs)) alike = false;
  });
  return alike;
}

/// The arrays of a Bvh, filled part by part.
class Filler {
 public:
  /// `materials`: by id; null where all are made of the same.
  Filler(std::size_t scanned, std::size_t leaves, const MaterialRef* materials)
      : materials_(materials) {
    bvh_.scanned = scanned;
    const std::size_t slots = padded(scanned) + leaves * bvh_leaf_size;
    bvh_.slots = LargeArray<std::int32_t>(slots);
    bvh_.blocks = LargeArray<SphereBlock>(slots / bvh_leaf_size);
    if (materials != nullptr) slot_materials_ = LargeArray<MaterialRef>(slots);
  }

  /// Fills the slots from the first one on, each with one of these spheres, and the rest of the
  /// last block with none.
  void fill_scanned(const std::vector<Sphere>& spheres, const std::vector<std::int32_t>& ids) {
    for (std::size_t first = 0; first < ids.size(); first += bvh_leaf_size) {
      BuildSphere some[bvh_leaf_size];
      const std::size_t size = std::min(bvh_leaf_size, ids.size() - first);
      for (std::size_t k = 0; k < size; ++k) {
        const Sphere& s = spheres[first + k];
        some[k] = {{s.center.x, s.center.y, s.center.z, s.radius}, ids[first + k]};
      }
      fill_block(first / bvh_leaf_size, some, size);
    }
  }

  /// Fills the leaves of one subtree. Threads may fill those of different ones.
  void fill_leaves(const BinaryForest& forest, const BinaryForest::Subtree& subtree) {
    const BuildSphere* from = forest.spheres_of(subtree).data();
    std::size_t block = padded(bvh_.scanned) / bvh_leaf_size + subtree.first_leaf;
    for (const BinaryNode& node : subtree.tree.nodes) {
      if (node.size == 0) continue;
      fill_block(block++, from, node.size);
      from += node.size + node.copies();
    }
  }

  void set_nodes(LargeArray<BvhNode> nodes) { bvh_.nodes = std::move(nodes); }

  /// `all`: what all spheres are made of, if they are made of the same.
  Bvh finish(MaterialRef all) {
    bvh_.materials =
        materials_ == nullptr ? SlotMaterials(all) : SlotMaterials(std::move(slot_materials_));
    return std::move(bvh_);
  }

 private:
  void fill_block(std::size_t index, const BuildSphere* spheres, std::size_t size) {
    SphereBlock block = empty_block();
    std::int32_t* const ids = bvh_.slots.data() + index * bvh_leaf_size;
    std::fill_n(ids, bvh_leaf_size, empty_slot);
    for (std::size_t k = 0; k < size; ++k) {
      set_sphere(block, k, spheres[k].at);
      ids[k] = spheres[k].id;
    }
    bvh_.blocks[index] = block;
    if (materials_ == nullptr) return;
    MaterialRef* const materials = slot_materials_.data() + index * bvh_leaf_size;
    std::fill_n(materials, bvh_leaf_size, MaterialRef());
    for (std::size_t k = 0; k < size; ++k)
      materials[k] = materials_[static_cast<std::size_t>(spheres[k].id)];
  }

  const MaterialRef* materials_;
  Bvh bvh_;
  LargeArray<MaterialRef> slot_materials_;
};

std::vector<Sphere> spheres_of(const std::vector<std::int32_t>& ids,
                               const std::vector<Sphere>& spheres) {
  std::vector<Sphere> some;
  some.reserve(ids.size());
  for (const std::int32_t id : ids) some.push_back(spheres[static_cast<std::size_t>(id)]);
  return some;
}

/// Makes the nodes and fills the leaves, some subtrees at a time. What these were made of is given
/// back at once: the spheres in order, the binary nodes subtree by subtree.
void fill_tree(BinaryForest& forest, LargeArray<BuildSphere>& spheres,
               const ParallelFor& parallel_for, Filler& filler) {
  const Collapse collapse(forest, parallel_for);
  LargeArray<BvhNode> nodes(collapse.size());
  // They lie far apart: written now, they would touch the pages of nearly all others.
  const std::vector<Collapse::PlacedNode> upper = collapse.make_upper();
  ConsumedPages consumed(spheres.data());
  const std::vector<std::uint32_t>& order = forest.order();
  constexpr std::size_t at_once = tuning::subtrees_at_once;
  for (std::size_t first = 0; first < order.size(); first += at_once) {
    const std::size_t end = std::min(first + at_once, order.size());
    parallel_for(end - first, [&](std::size_t i) {
      const std::uint32_t subtree = order[first + i];
      collapse.make_subtree(subtree, nodes.data());
      filler.fill_leaves(forest, forest.subtrees()[subtree]);
      forest.drop(subtree);
    });
    consumed.consume(spheres.data() + forest.subtrees()[order[end - 1]].end);
  }
  for (const auto& [index, node] : upper) nodes[index] = node;
  filler.set_nodes(std::move(nodes));
}

}  // namespace

SphereBlock empty_block() {
  SphereBlock block{};
  std::fill_n(block.radius, bvh_leaf_size, std::numeric_limits<float>::quiet_NaN());
  return block;
}

Bvh build_bvh(std::vector<Sphere> spheres, const ParallelFor& parallel_for,
              const TreePlace& place) {
  std::vector<std::int32_t> apart;
  if (place.keeps_apart) apart = find_spheres_apart(spheres, parallel_for);
  const std::vector<std::int32_t> scanned = without_copies(apart, spheres);
  const std::vector<Sphere> scanned_spheres = spheres_of(scanned, spheres);
  const MaterialRef first_material = spheres.empty() ? MaterialRef() : spheres[0].material;
  LargeArray<MaterialRef> materials;
  if (!are_alike(spheres, parallel_for)) materials = LargeArray<MaterialRef>(spheres.size());
  LargeArray<BuildSphere> others(spheres.size() - apart.size());
  gather_others(spheres, apart, others.data(), materials.data(), parallel_for);
  std::vector<Sphere>().swap(spheres);
  if (others.empty()) {
    Filler filler(padded(scanned.size()), 0, materials.data());
    filler.fill_scanned(scanned_spheres, scanned);
    return filler.finish(first_material);
  }
  const ParallelFor fill_for = others.size() <= tuning::chunk_size ? serial_for : parallel_for;
  BinaryForest forest({others.data(), others.size()}, parallel_for, place.depth);
  Filler filler(padded(scanned.size()), forest.leaves(), materials.data());
  filler.fill_scanned(scanned_spheres, scanned);
  fill_tree(forest, others, fill_for, filler);
  return filler.finish(first_material);
}

Bvh no_bvh(const std::vector<Sphere>& spheres) {
  std::vector<std::int32_t> ids(spheres.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<MaterialRef> materials;
  if (!are_alike(spheres, serial_for)) {
    for (const Sphere& sphere : spheres) materials.push_back(sphere.material);
  }
  Filler filler(spheres.size(), 0, materials.empty() ? nullptr : materials.data());
  filler.fill_scanned(spheres, ids);
  return filler.finish(spheres.empty() ? MaterialRef() : spheres[0].material);
}

}  // namespace boule
