#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/geometry/part_placement.h"
#include "simd/points/near_queries.h"

namespace boule {

/// A block of spheres as placed in the scene, which fills some of its slots.
class PlacedBlock {
 public:
  PlacedBlock() = default;
  PlacedBlock(const SphereBlock& spheres, const std::int32_t* id) : own_(&spheres), id_(id) {}
  /// Block `index` of a part.
  PlacedBlock(const PartView& part, std::size_t index)
      : own_(part.blocks + index), id_(part.id + index * bvh_leaf_size), first_id_(part.first_id) {
    if (!part.placement.moves) return;
    own_ = nullptr;
    moved_ = part.blocks[index];
    for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
      if (std::isnan(moved_.radius[k])) continue;
      const Sphere sphere = sphere_of(part, index * bvh_leaf_size + k);
      moved_.center_x[k] = sphere.center.x;
      moved_.center_y[k] = sphere.center.y;
      moved_.center_z[k] = sphere.center.z;
      moved_.radius[k] = sphere.radius;
    }
  }

  /// The centres and radii; the radius of an empty slot is NaN.
  [[nodiscard]] const SphereBlock& spheres() const { return own_ != nullptr ? *own_ : moved_; }
  /// The id in a slot. Precondition: it is not empty.
  [[nodiscard]] std::int32_t id(std::size_t k) const { return first_id_ + id_[k]; }

 private:
  const SphereBlock* own_ = nullptr;  ///< null: they are moved
  const std::int32_t* id_ = nullptr;
  std::int32_t first_id_ = 0;
  SphereBlock moved_;
};

/// All spheres of a geometry in blocks, those of each close to one another, and the trees over
/// them. Blocks count on from part to part.
class SphereBlocks {
 public:
  explicit SphereBlocks(const GeometryView& geometry) : geometry_(geometry) {}

  [[nodiscard]] std::size_t size() const {
    const PartsView& parts = geometry_.parts;
    if (parts.size == 0) return geometry_.spheres.block_count;
    const PartView& last = parts.parts[parts.size - 1];
    return (std::size_t{last.first_slot} + last.slots) / bvh_leaf_size;
  }

  [[nodiscard]] PlacedBlock at(std::size_t block) const {
    const PartsView& parts = geometry_.parts;
    const SphereView& spheres = geometry_.spheres;
    if (parts.size == 0) return {spheres.blocks[block], spheres.id + block * bvh_leaf_size};
    const auto comes_before = [](std::size_t index, const PartView& part) {
      return index < part.first_slot / bvh_leaf_size;
    };
    const PartView* const after =
        std::upper_bound(parts.parts, parts.parts + parts.size, block, comes_before);
    return {after[-1], block - after[-1].first_slot / bvh_leaf_size};
  }

  /// Calls visit(block) for the blocks that may hold spheres near what a query asks for: NearPoint
  /// or NearBox.
  template <class Query, class Visit>
  void visit_near(const Query& query, const Visit& visit) const {
    if (geometry_.parts.size > 0) {
      query.visit(geometry_.bvh, [&](std::uint32_t part) {
        visit_part(geometry_.parts.parts[part], query, visit);
      });
      return;
    }
    const std::size_t scanned = (geometry_.spheres.scanned + bvh_leaf_size - 1) / bvh_leaf_size;
    for (std::size_t block = 0; block < scanned; ++block) visit(block);
    query.visit(geometry_.bvh, [&](std::uint32_t leaf) { visit(scanned + leaf); });
  }

 private:
  /// A part's tree is walked in the part's own coordinates.
  template <class Query, class Visit>
  void visit_part(const PartView& part, const Query& query, const Visit& visit) const {
    const std::size_t first = part.first_slot / bvh_leaf_size;
    const std::size_t scanned = part.scanned / bvh_leaf_size;
    for (std::size_t block = 0; block < scanned; ++block) visit(first + block);
    if (part.nodes == nullptr) return;
    const BvhView bvh{part.nodes, 1, geometry_.bvh.extent};
    query.in_part(part.placement, double{geometry_.bvh.extent}, [&](const auto& own) {
      own.visit(bvh, [&](std::uint32_t leaf) { visit(first + scanned + leaf); });
    });
  }

  const GeometryView& geometry_;
};

}  // namespace boule
