#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/points/near_queries.h"
#include "simd/points/node_distances.h"
#include "simd/points/point_distance.h"
#include "simd/points/sphere_blocks.h"

namespace boule {

/// Shows a visitor the primitives that may be near a point. The visitor has limit(), the largest
/// distance that it still asks for, which may fall from call to call, and meet(primitive, id) for
/// a Ball, a Capsule and a Plane: it is called for every primitive whose distance is at most
/// limit(), and for some others. Preconditions: those of point_distance.h.
template <class Visitor>
class PointSearch {
 public:
  PointSearch(const GeometryView& geometry, Visitor& visitor)
      : geometry_(geometry), spheres_(geometry), visitor_(visitor) {}

  void search(const Vec3d& point) {
    const auto limit = [this] { return visitor_.limit(); };
    const NearPoint near(point, limit);
    spheres_.visit_near(near, [&](std::size_t block) { meet_block(block, point); });
    meet_planes();
    if (geometry_.capsules.slots > 0) meet_capsules(near);
  }

 private:
  void meet_block(std::size_t index, const Vec3d& point) {
    const PlacedBlock placed = spheres_.at(index);
    const SphereBlock& block = placed.spheres();
    const BlockDistances distances(block, point, visitor_.limit());
    for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
      if (distances.may_be_near(k)) visitor_.meet(ball_in(block, k), placed.id(k));
    }
  }

  void meet_planes() {
    const PlaneView& planes = geometry_.planes;
    for (std::size_t i = 0; i < planes.size; ++i) {
      visitor_.meet(Plane{{planes.point_x[i], planes.point_y[i], planes.point_z[i]},
                          {planes.normal_x[i], planes.normal_y[i], planes.normal_z[i]}},
                    planes.first_id + static_cast<std::int32_t>(i));
    }
  }

  template <class Near>
  void meet_capsules(const Near& near) {
    const CapsuleView& capsules = geometry_.capsules;
    const auto meet = [&](std::size_t index) {
      const CapsuleBlock& block = capsules.blocks[index];
      for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
        if (std::isnan(block.radius[k])) continue;  // an empty slot
        visitor_.meet(Capsule{{block.a_x[k], block.a_y[k], block.a_z[k]},
                              {block.b_x[k], block.b_y[k], block.b_z[k]},
                              std::fabs(block.radius[k])},
                      capsules.id[index * bvh_leaf_size + k]);
      }
    };
    const std::size_t scanned = capsules.scanned / bvh_leaf_size;
    for (std::size_t block = 0; block < scanned; ++block) meet(block);
    near.visit(capsules.bvh, [&](std::uint32_t leaf) { meet(scanned + leaf); });
  }

  const GeometryView& geometry_;
  SphereBlocks spheres_;
  Visitor& visitor_;
};

}  // namespace boule
