#include "simd/geometry/bvh_builder.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
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

/// Whether all spheres have the same material.
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

enum class Materials { alike, by_slot };

/// The arrays of a Bvh, filled part by part.
class Filler {
 public:
  Filler(std::size_t scanned, Materials materials)
      : has_materials_(materials == Materials::by_slot) {
    bvh_.scanned = scanned;
    set_leaves(0);
  }

  /// Makes room for this many leaves in all, which are filled later.
  void set_leaves(std::size_t leaves) {
    const std::size_t slots = padded(bvh_.scanned) + leaves * bvh_leaf_size;
    bvh_.slots.resize(slots);
    bvh_.blocks.resize(slots / bvh_leaf_size);
    if (has_materials_) materials_.resize(slots);
  }
  void set_nodes(std::size_t nodes) { bvh_.nodes.resize(nodes); }
  BvhNode* nodes() { return bvh_.nodes.data(); }

  /// Reserves the usual size of a tree over this many spheres, so that little moves later.
  void expect(std::size_t spheres) {
    constexpr std::size_t usual_leaf = 10, usual_node = 8;
    const std::size_t leaves = spheres / usual_leaf + 1;
    set_leaves(leaves);
    bvh_.nodes.reserve(leaves / usual_node + 1);
    set_leaves(0);
  }

  /// Fills the slots from the first one on, each with one of these spheres, and leaves the rest of
  /// the last block empty.
  void fill_scanned(const std::vector<Sphere>& spheres, const std::vector<std::int32_t>& ids) {
    for (std::size_t first = 0; first < ids.size(); first += bvh_leaf_size) {
      BuildSphere some[bvh_leaf_size];
      const std::size_t size = std::min(bvh_leaf_size, ids.size() - first);
      for (std::size_t k = 0; k < size; ++k) {
        const Sphere& s = spheres[first + k];
        some[k] = {{s.center.x, s.center.y, s.center.z, s.radius}, ids[first + k]};
      }
      fill_block(first / bvh_leaf_size, {some, size});
      if (!has_materials_) continue;
      for (std::size_t k = 0; k < size; ++k) materials_[first + k] = spheres[first + k].material;
    }
  }

  /// The place of a subtree's leaves, and the ids and materials of its spheres by their indices in
  /// the subtree, which the spheres hold in place of their ids. `materials` is null if all are the
  /// same.
  struct LeafSource {
    std::size_t first_leaf;
    const std::int32_t* ids;
    const MaterialRef* materials;
    std::vector<SphereCopy>* copies;  ///< output: the spheres that are left out
  };

  /// Fills the leaves of one subtree. Threads may fill different subtrees in parallel.
  void fill_leaves(const BinaryForest& forest, const BinaryForest::Subtree& subtree,
                   const LeafSource& source) {
    std::span<const BuildSphere> from = forest.spheres_of(subtree);
    std::size_t block = padded(bvh_.scanned) / bvh_leaf_size + source.first_leaf;
    for (const BinaryNode& node : subtree.tree.nodes) {
      if (node.size == 0) continue;
      fill_block(block, from.first(node.size));
      if (has_materials_) name_spheres(block, node.size, source);
      const auto left_out = from.subspan(node.size, node.copies());
      for (const BuildSphere& copy : left_out) {
        source.copies->push_back(
            {id_of(from[0], source), id_of(from[1], source), id_of(copy, source)});
      }
      ++block;
      from = from.subspan(node.size + node.copies());
    }
  }

  void add_copies(const std::vector<SphereCopy>& copies) {
    bvh_.copies.insert(bvh_.copies.end(), copies.begin(), copies.end());
  }

  /// `all`: the material of all spheres, if it is the same.
  Bvh finish(MaterialRef all) {
    std::sort(bvh_.copies.begin(), bvh_.copies.end());
    bvh_.slots.shrink_to_fit();
    bvh_.blocks.shrink_to_fit();
    bvh_.nodes.shrink_to_fit();
    materials_.shrink_to_fit();
    bvh_.materials = has_materials_ ? SlotMaterials(std::move(materials_)) : SlotMaterials(all);
    return std::move(bvh_);
  }

 private:
  void fill_block(std::size_t index, std::span<const BuildSphere> spheres) {
    SphereBlock block = empty_block();
    std::int32_t* const ids = bvh_.slots.data() + index * bvh_leaf_size;
    std::fill_n(ids, bvh_leaf_size, empty_slot);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      set_sphere(block, k, spheres[k].at);
      ids[k] = spheres[k].id;
    }
    bvh_.blocks[index] = block;
    if (has_materials_)
      std::fill_n(materials_.data() + index * bvh_leaf_size, bvh_leaf_size, MaterialRef());
  }

  [[nodiscard]] std::int32_t id_of(const BuildSphere& sphere, const LeafSource& source) const {
    return has_materials_ ? source.ids[static_cast<std::size_t>(sphere.id)] : sphere.id;
  }

  /// Replaces indices by ids and materials.
  void name_spheres(std::size_t block, std::size_t size, const LeafSource& source) {
    std::int32_t* const ids = bvh_.slots.data() + block * bvh_leaf_size;
    MaterialRef* const materials = materials_.data() + block * bvh_leaf_size;
    for (std::size_t k = 0; k < size; ++k) {
      const auto place = static_cast<std::size_t>(ids[k]);
      ids[k] = source.ids[place];
      materials[k] = source.materials[place];
    }
  }

  bool has_materials_;
  Bvh bvh_;
  LargeArray<MaterialRef> materials_;
};

std::vector<Sphere> spheres_of(const std::vector<std::int32_t>& ids,
                               const std::vector<Sphere>& spheres) {
  std::vector<Sphere> some;
  some.reserve(ids.size());
  for (const std::int32_t id : ids) some.push_back(spheres[static_cast<std::size_t>(id)]);
  return some;
}

/// The materials of spheres in the order of the spheres.
LargeArray<MaterialRef> by_place(const LargeArray<MaterialRef>& by_id,
                                 std::span<const BuildSphere> spheres,
                                 const ParallelFor& parallel_for) {
  if (by_id.empty()) return {};
  LargeArray<MaterialRef> materials(spheres.size());
  constexpr std::size_t chunk = tuning::chunk_size;
  parallel_for((spheres.size() + chunk - 1) / chunk, [&](std::size_t i) {
    const std::size_t end = std::min((i + 1) * chunk, spheres.size());
    for (std::size_t at = i * chunk; at < end; ++at)
      materials[at] = by_id[static_cast<std::size_t>(spheres[at].id)];
  });
  return materials;
}

/// Builds the subtrees, makes the nodes and fills the leaves, some subtrees at a time. Gives back
/// at once the memory of their sources: the spheres, their materials in order, and the binary
/// nodes. `materials` are by the spheres' places; empty if all are the same.
class TreeFiller {
 public:
  TreeFiller(BinaryForest& forest, std::span<BuildSphere> spheres,
             LargeArray<MaterialRef> materials, Filler& filler)
      : forest_(forest),
        spheres_(spheres),
        materials_(std::move(materials)),
        filler_(filler),
        parts_(forest.subtrees().size()),
        used_spheres_(spheres.data()),
        used_materials_(materials_.data()) {}

  void fill(const ParallelFor& parallel_for) {
    filler_.expect(spheres_.size());
    parallel_for(parts_.size(), [&](std::size_t i) {
      if (forest_.is_twig(i)) build(i);
    });
    forest_.weigh();
    collapse_.emplace(forest_);
    const std::size_t at_once = std::max(parts_.size() / tuning::portions, tuning::least_portion);
    for (std::size_t first = 0; first < parts_.size(); first += at_once)
      fill_portion(first, std::min(first + at_once, parts_.size()), parallel_for);
    forest_.finish();
    collapse_->make_upper(filler_.nodes());
    for (const Part& part : parts_) filler_.add_copies(part.copies);
  }

 private:
  /// The data of a subtree until its leaves are filled.
  struct Part {
    std::size_t nodes = 0;
    std::vector<std::int32_t> ids{};
    std::vector<SphereCopy> copies{};
  };

  void fill_portion(std::size_t first, std::size_t end, const ParallelFor& parallel_for) {
    const std::vector<BinaryForest::Subtree>& subtrees = forest_.subtrees();
    parallel_for(end - first, [&](std::size_t i) {
      if (!forest_.is_twig(first + i)) build(first + i);
      parts_[first + i].nodes = collapse_->count_nodes(first + i);
    });
    for (std::size_t i = first; i < end; ++i)
      collapse_->place_next(parts_[i].nodes, subtrees[i].tree.leaves);
    filler_.set_leaves(collapse_->leaf_count());
    filler_.set_nodes(collapse_->node_count());
    parallel_for(end - first, [&](std::size_t i) { fill_subtree(first + i); });
    const std::size_t used = subtrees[end - 1].end;
    used_spheres_.consume(spheres_.data() + used);
    if (!materials_.empty()) used_materials_.consume(materials_.data() + used);
  }

  void build(std::size_t subtree) {
    forest_.build(subtree, materials_.empty() ? nullptr : &parts_[subtree].ids);
  }

  void fill_subtree(std::size_t index) {
    const BinaryForest::Subtree& subtree = forest_.subtrees()[index];
    const MaterialRef* const materials =
        materials_.empty() ? nullptr : materials_.data() + subtree.begin;
    collapse_->make_subtree(index, filler_.nodes());
    filler_.fill_leaves(
        forest_, subtree,
        {collapse_->first_leaf(index), parts_[index].ids.data(), materials, &parts_[index].copies});
    std::vector<std::int32_t>().swap(parts_[index].ids);
    if (!forest_.is_twig(index)) forest_.drop(index);
  }

  BinaryForest& forest_;
  std::span<BuildSphere> spheres_;
  LargeArray<MaterialRef> materials_;
  Filler& filler_;
  std::optional<Collapse> collapse_;  ///< set once the twigs are built
  std::vector<Part> parts_;           ///< by subtree
  ConsumedPages used_spheres_, used_materials_;
};

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
  std::vector<SphereCopy> copies;
  const std::vector<std::int32_t> scanned = without_copies(apart, spheres, copies);
  const std::vector<Sphere> scanned_spheres = spheres_of(scanned, spheres);
  const MaterialRef first_material = spheres.empty() ? MaterialRef() : spheres[0].material;
  const bool alike = are_alike(spheres, parallel_for);
  Filler filler(padded(scanned.size()), alike ? Materials::alike : Materials::by_slot);
  filler.fill_scanned(scanned_spheres, scanned);
  filler.add_copies(copies);
  LargeArray<MaterialRef> materials(alike ? 0 : spheres.size());
  const std::span<BuildSphere> others = take_others(spheres, apart, materials.data(), parallel_for);
  if (others.empty()) return filler.finish(first_material);
  BinaryForest forest(others, parallel_for, place.depth);
  materials = by_place(materials, others, parallel_for);
  const ParallelFor fill_for = others.size() <= tuning::chunk_size ? serial_for : parallel_for;
  TreeFiller(forest, others, std::move(materials), filler).fill(fill_for);
  return filler.finish(first_material);
}

Bvh no_bvh(const std::vector<Sphere>& spheres) {
  std::vector<std::int32_t> ids(spheres.size());
  std::iota(ids.begin(), ids.end(), 0);
  const bool alike = are_alike(spheres, serial_for);
  Filler filler(spheres.size(), alike ? Materials::alike : Materials::by_slot);
  filler.fill_scanned(spheres, ids);
  return filler.finish(spheres.empty() ? MaterialRef() : spheres[0].material);
}

}  // namespace boule
