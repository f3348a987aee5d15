#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/math/ray.h"
#include "core/math/vec.h"
#include "simd/abi/bvh.h"
#include "simd/abi/geometry.h"
#include "simd/points/node_distances.h"

namespace boule {

/// What a tree is asked for. visit(bvh, visit) calls visit(leaf) for the leaves that may hold it.
/// in_part(place, extent, use) calls use(query) with the query in the coordinates of a part of a
/// scene, whose boxes reach as far as `extent`. A part's spheres are moved to the scene and rounded
/// there: the query is somewhat wider for that.

/// A part's own coordinates.
class OwnSpace {
 public:
  OwnSpace(const PlacementView& place, double extent)
      : place_(place), scale_(place.moves ? place.scale : 1), extent_(extent) {}

  [[nodiscard]] Vec3d point(const Vec3d& p) const {
    return place_.moves ? turned(p - place_.shift, [](double x) { return x; }) : p;
  }
  /// Half of the size of a box around a box of half that size.
  [[nodiscard]] Vec3d half_size(const Vec3d& half) const {
    return place_.moves ? turned(half, [](double x) { return std::fabs(x); }) : half;
  }
  /// A distance from a point, and some more for rounding.
  [[nodiscard]] double reach(double distance, const Vec3d& p) const {
    if (!place_.moves) return distance;
    const double slack = 0x1p-20 * extent_ + 0x1p-45 * (size_of(p - place_.shift) + size_of(p));
    return (distance + slack) / scale_;
  }

 private:
  template <class Each>
  [[nodiscard]] Vec3d turned(const Vec3d& v, const Each& each) const {
    const auto row = [&each](const Vec3d& r) { return Vec3d{each(r.x), each(r.y), each(r.z)}; };
    return (row(place_.row_x) * v.x + row(place_.row_y) * v.y + row(place_.row_z) * v.z) *
           (1 / scale_);
  }
  static double size_of(const Vec3d& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

  const PlacementView& place_;
  double scale_, extent_;
};

/// All within limit() of a point, which may fall from call to call; the nearest leaves come first
/// as far as boxes tell.
template <class Limit>
class NearPoint {
 public:
  NearPoint(const Vec3d& point, const Limit& limit) : point_(point), limit_(limit) {}

  template <class Visit>
  void visit(const BvhView& bvh, const Visit& visit) const {
    if (bvh.size == 0) return;
    NearNodes nodes(bvh, point_);
    while (nodes.take(limit_())) {
      if (nodes.is_leaf()) {
        visit(nodes.index());
      } else {
        nodes.open(limit_());
      }
    }
  }
  template <class Use>
  void in_part(const PlacementView& place, double extent, const Use& use) const {
    const OwnSpace own(place, extent);
    const auto limit = [&] { return own.reach(limit_(), point_); };
    use(NearPoint<decltype(limit)>(own.point(point_), limit));
  }

 private:
  Vec3d point_;
  const Limit& limit_;
};

/// All that a box meets, whose sizes are below 1e300.
class NearBox {
 public:
  NearBox(const Vec3d& middle, const Vec3d& half) : middle_(middle), half_(half) {}

  template <class Visit>
  void visit(const BvhView& bvh, const Visit& visit) const {
    if (bvh.size == 0) return;
    const Vec3f least{low(middle_.x, half_.x), low(middle_.y, half_.y), low(middle_.z, half_.z)};
    const Vec3f most{high(middle_.x, half_.x), high(middle_.y, half_.y), high(middle_.z, half_.z)};
    std::array<std::uint32_t, bvh_max_depth*(bvh_width - 1) + 1> waiting;
    waiting[0] = 0;
    for (std::size_t count = 1; count > 0;) {
      const std::uint32_t next = waiting[--count];
      if ((next & leaf_bit) != 0) {
        visit(index_of(next));
        continue;
      }
      const BvhNode& node = bvh.nodes[next];
      for (std::uint32_t in = met(node, least, most); in != 0; in &= in - 1)
        waiting[count++] = node.child[std::countr_zero(in)];
    }
  }
  template <class Use>
  void in_part(const PlacementView& place, double extent, const Use& use) const {
    const OwnSpace own(place, extent);
    const double more = own.reach(0, middle_);
    use(NearBox(own.point(middle_), own.half_size(half_) + Vec3d{more, more, more}));
  }

 private:
  /// The ends of an axis, and some more for rounding.
  static float high(double middle, double half) {
    return float_above(middle + half + 0x1p-45 * (std::fabs(middle) + half));
  }
  static float low(double middle, double half) { return -high(-middle, half); }
  /// The children of a node that a box meets, as bits.
  static std::uint32_t met(const BvhNode& node, const Vec3f& least, const Vec3f& most) {
    std::uint32_t in = 0;
    for (std::size_t k = 0; k < bvh_width; ++k) {
      const bool meets = (node.min_x[k] <= most.x) & (least.x <= node.max_x[k]) &
                         (node.min_y[k] <= most.y) & (least.y <= node.max_y[k]) &
                         (node.min_z[k] <= most.z) & (least.z <= node.max_z[k]);
      in |= meets ? 1U << k : 0U;
    }
    return in & ((1U << node.size) - 1);
  }

  Vec3d middle_, half_;
};

}  // namespace boule
