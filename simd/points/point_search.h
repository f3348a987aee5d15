#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/math/similarity.h"
#include "simd/abi/geometry.h"
#include "simd/geometry/part_placement.h"
#include "simd/points/node_distances.h"
#include "simd/points/point_distance.h"

namespace boule {

/// Shows a visitor the primitives that may be near a point. The visitor has limit(), the largest
/// distance that it still asks for, which may fall from call to call, and meet(primitive, id) for
/// a Ball, a Capsule and a Plane: it is called for every primitive whose distance is at most
/// limit(), and for some others. Preconditions: those of point_distance.h.
template <class Visitor>
class PointSearch {
 public:
  PointSearch(const GeometryView& geometry, Visitor& visitor)
      : geometry_(geometry), visitor_(visitor) {}

  void search(const Vec3d& point) {
    point_ = point;
    if (geometry_.parts.size > 0) {
      const auto limit = [this] { return visitor_.limit(); };
      walk(geometry_.bvh, point, limit,
           [this](std::uint32_t part, std::size_t) { meet_part(geometry_.parts.parts[part]); });
    } else {
      meet_spheres();
    }
    meet_planes();
    if (geometry_.capsules.slots > 0) meet_capsules();
  }

 private:
  /// Calls visit(leaf, size) for the leaves whose box is within limit() of the point, the nearest
  /// first as far as boxes tell.
  template <class Limit, class Visit>
  static void walk(const BvhView& bvh, const Vec3d& point, const Limit& limit, const Visit& visit) {
    if (bvh.size == 0) return;
    NearNodes nodes(bvh, point);
    while (nodes.take(limit())) {
      if (nodes.is_leaf()) {
        visit(nodes.index(), nodes.leaf_size());
      } else {
        nodes.open(limit());
      }
    }
  }

  void meet_spheres() {
    const SphereView& spheres = geometry_.spheres;
    const std::size_t scanned = (spheres.scanned + bvh_leaf_size - 1) / bvh_leaf_size;
    for (std::size_t i = 0; i < scanned; ++i) meet_block(i, bvh_leaf_size);
    walk(
        geometry_.bvh, point_, [this] { return visitor_.limit(); },
        [this, scanned](std::uint32_t leaf, std::size_t size) {
          meet_block(scanned + leaf, size);
        });
  }

  void meet_block(std::size_t index, std::size_t size) {
    const SphereBlock& block = geometry_.spheres.blocks[index];
    BlockDistances distances(block, point_, visitor_.limit());
    for (std::size_t k = 0; k < size; ++k) {
      if (!distances.may_be_near(k)) continue;
      visitor_.meet(Ball{{block.center_x[k], block.center_y[k], block.center_z[k]},
                         std::fabs(block.radius[k])},
                    geometry_.spheres.id[index * bvh_leaf_size + k]);
    }
  }

  /// A part's tree is walked in the part's own coordinates. Its spheres are moved to the scene and
  /// rounded there: `slack` pays for that.
  void meet_part(const PartView& part) {
    const PlacementView& place = part.placement;
    const Vec3d away = point_ - place.shift;
    const Vec3d own{(place.row_x.x * away.x + place.row_y.x * away.y + place.row_z.x * away.z),
                    (place.row_x.y * away.x + place.row_y.y * away.y + place.row_z.y * away.z),
                    (place.row_x.z * away.x + place.row_y.z * away.y + place.row_z.z * away.z)};
    const double scale = place.moves ? place.scale : 1;
    const Vec3d point = place.moves ? own * (1 / scale) : point_;
    const double size = std::fabs(away.x) + std::fabs(away.y) + std::fabs(away.z) +
                        std::fabs(point_.x) + std::fabs(point_.y) + std::fabs(point_.z);
    const double slack = place.moves ? 0x1p-20 * double{geometry_.bvh.extent} + 0x1p-45 * size : 0;
    const auto limit = [&] { return (visitor_.limit() + slack) / scale; };
    const auto meet = [&](std::size_t slot) {
      if (part.id[slot] < 0) return;
      const Sphere sphere = sphere_of(part, slot);
      visitor_.meet(Ball{sphere.center, std::fabs(sphere.radius)}, part.first_id + part.id[slot]);
    };
    for (std::size_t slot = 0; slot < part.scanned_spheres; ++slot) meet(slot);
    if (part.nodes == nullptr) return;
    const BvhView tree{part.nodes, 1, geometry_.bvh.extent};
    walk(tree, point, limit, [&](std::uint32_t leaf, std::size_t size_of_leaf) {
      const std::size_t first = part.scanned + leaf * bvh_leaf_size;
      for (std::size_t k = 0; k < size_of_leaf; ++k) meet(first + k);
    });
  }

  void meet_planes() {
    const PlaneView& planes = geometry_.planes;
    for (std::size_t i = 0; i < planes.size; ++i) {
      visitor_.meet(Plane{{planes.point_x[i], planes.point_y[i], planes.point_z[i]},
                          {planes.normal_x[i], planes.normal_y[i], planes.normal_z[i]}},
                    planes.first_id + static_cast<std::int32_t>(i));
    }
  }

  void meet_capsules() {
    const CapsuleView& capsules = geometry_.capsules;
    const auto meet = [&](std::size_t slot) {
      if (capsules.id[slot] < 0) return;
      const CapsuleBlock& block = capsules.blocks[slot / bvh_leaf_size];
      const std::size_t k = slot % bvh_leaf_size;
      visitor_.meet(Capsule{{block.a_x[k], block.a_y[k], block.a_z[k]},
                            {block.b_x[k], block.b_y[k], block.b_z[k]},
                            std::fabs(block.radius[k])},
                    capsules.id[slot]);
    };
    for (std::size_t slot = 0; slot < capsules.scanned; ++slot) meet(slot);
    walk(
        capsules.bvh, point_, [this] { return visitor_.limit(); },
        [&](std::uint32_t leaf, std::size_t size) {
          const std::size_t first = capsules.scanned + leaf * bvh_leaf_size;
          for (std::size_t k = 0; k < size; ++k) meet(first + k);
        });
  }

  const GeometryView& geometry_;
  Visitor& visitor_;
  Vec3d point_{};
};

/// All spheres of a geometry, in blocks of up to 16 that are close to one another.
class SphereBlocks {
 public:
  explicit SphereBlocks(const GeometryView& geometry) : geometry_(geometry) {}

  [[nodiscard]] std::size_t size() const {
    const PartsView& parts = geometry_.parts;
    if (parts.size == 0) return geometry_.spheres.block_count;
    const PartView& last = parts.parts[parts.size - 1];
    return (std::size_t{last.first_slot} + last.slots) / bvh_leaf_size;
  }

  /// Calls visit(sphere, id) for the spheres of a block.
  template <class Visit>
  void visit(std::size_t block, const Visit& visit_sphere) const {
    const PartView part = part_at(block);
    const std::size_t first = block * bvh_leaf_size - part.first_slot;
    for (std::size_t slot = first; slot < first + bvh_leaf_size; ++slot) {
      const Sphere sphere = sphere_of(part, slot);
      if (std::isnan(sphere.radius)) continue;  // an empty slot
      visit_sphere(sphere, part.first_id + part.id[slot]);
    }
  }

 private:
  /// The part that holds a block; all spheres if there are no parts.
  [[nodiscard]] PartView part_at(std::size_t block) const {
    const PartsView& parts = geometry_.parts;
    if (parts.size == 0) {
      PartView all{};
      all.blocks = geometry_.spheres.blocks;
      all.id = geometry_.spheres.id;
      return all;
    }
    const auto comes_before = [](std::size_t slot, const PartView& part) {
      return slot < part.first_slot;
    };
    return *(std::upper_bound(parts.parts, parts.parts + parts.size, block * bvh_leaf_size,
                              comes_before) -
             1);
  }

  const GeometryView& geometry_;
};

}  // namespace boule
