#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/bvh.h"
#include "simd/kernel/search/bundle/bundle_discs.h"
#include "simd/kernel/search/bundle/bundle_rays.h"

/// A bundle against the boxes of a node: sixteen of them, W at a time, against the four planes that
/// hold all rays. The test rejects only boxes that every ray misses; docs/numerics.md derives the
/// slack (filter::box).
namespace boule::BOULE_KERNEL_ISA {

/// The four sides of a bundle, and its depth, for boxes in world coordinates.
template <Common common>
class BundleSides {
 public:
  explicit BundleSides(const BundleRays& rays) : org_(narrow_all(rays.frame.org)) {
    const BundleFrame& frame = rays.frame;
    // The error of a and b is at most this.
    const double off = double{filter::bundle_axis} * filter::u * double{rays.across};
    const Extent& e = rays.extent;
    if constexpr (common == Common::direction) {
      const float c_off = static_cast<float>(filter::bundle_depth * filter::u) * rays.across;
      c_low_ = rays.c_low - c_off;
      c_high_ = rays.c_high + c_off;
    }
    set_side(sides_[0], frame.u, frame.w, double{e.a_low} - off, 1);
    set_side(sides_[1], frame.u, frame.w, double{e.a_high} + off, -1);
    set_side(sides_[2], frame.v, frame.w, double{e.b_low} - off, 1);
    set_side(sides_[3], frame.v, frame.w, double{e.b_high} + off, -1);
    set_side(depth_, frame.w, frame.w, 0, 1);
    set_side(across_[0], frame.u, frame.w, 0, 1);
    set_side(across_[1], frame.v, frame.w, 0, 1);
    off_ = static_cast<float>(off);
    shift_ = rays.shift + static_cast<float>(filter::floor);
  }

  /// Computes the bundle's view of the boxes of a node. `extent`: that of all rays.
  BOULE_NOINLINE void view(const BvhNode& node, const Extent& extent, BoxViews& views) const {
    const Real none(static_cast<float>(no_hit)), zero(0.0F);
    const auto known = [](const Real& x, const Real& otherwise) {
      return select(x <= x, x, otherwise);  // NaN means unknown
    };
    for (std::size_t part = 0; part * width < bvh_width; ++part) {
      const Boxes boxes = boxes_of(node, part);
      const Range depth = distances(depth_, boxes);
      const Range a = slopes(across_[0], boxes, depth), b = slopes(across_[1], boxes, depth);
      const Real a_low = known(a.low, zero - none), a_high = known(a.high, none);
      const Real b_low = known(b.low, zero - none), b_high = known(b.high, none);
      const std::size_t at = part * width;
      store(views.a_low + at, a_low);
      store(views.a_high + at, a_high);
      store(views.b_low + at, b_low);
      store(views.b_high + at, b_high);
      const Real wide = filter_min(a_high, extent.a_high) - filter_max(a_low, extent.a_low);
      const Real high = filter_min(b_high, extent.b_high) - filter_max(b_low, extent.b_low);
      store(views.area + at, filter_max(wide, zero) * filter_max(high, zero));
    }
  }

  /// The children of a node that every ray misses before `limit`, as bits. Writes to `near` a lower
  /// bound of the v at which each is entered.
  BOULE_INLINE unsigned find_missed(const BvhNode& node, float limit, float* near) const {
    unsigned out = 0;
    for (std::size_t part = 0; part * width < bvh_width; ++part)
      out |= find_missed_part(node, part, limit, near) << (part * width);
    return out;
  }

 private:
  /// A plane; points with n.(p - O) >= offset are inside. `far` and `near` give the rows of a box
  /// (min x, y, z, max x, y, z) with the corner that lies farthest inside, and with the opposite
  /// one.
  struct Side {
    float x, y, z, offset;
    int far[3], near[3];
  };

  static void set_side(Side& side, const Vec3d& axis, const Vec3d& w, double at, double sign) {
    const bool one_origin = common != Common::direction;
    const Vec3d n = (one_origin ? axis - w * at : axis) * sign;
    side.x = static_cast<float>(n.x);
    side.y = static_cast<float>(n.y);
    side.z = static_cast<float>(n.z);
    side.offset = one_origin ? 0.0F : static_cast<float>(at * sign);
    const double along[3] = {n.x, n.y, n.z};
    for (int k = 0; k < 3; ++k) {
      side.far[k] = along[k] > 0 ? k + 3 : k;
      side.near[k] = along[k] > 0 ? k : k + 3;
    }
  }

  /// W boxes relative to O, and a bound of the error of their corners' distances (filter_bounds.h).
  struct Boxes {
    Real rows[6];
    Real slack;
  };
  BOULE_INLINE Boxes boxes_of(const BvhNode& node, std::size_t part) const {
    const std::size_t at = part * width;
    Boxes boxes = {{load(node.min_x + at) - org_.x, load(node.min_y + at) - org_.y,
                    load(node.min_z + at) - org_.z, load(node.max_x + at) - org_.x,
                    load(node.max_y + at) - org_.y, load(node.max_z + at) - org_.z},
                   Real(0.0F)};
    const Real(&rows)[6] = boxes.rows;
    const Real size = filter_max(abs(rows[0]), abs(rows[3])) +
                      filter_max(abs(rows[1]), abs(rows[4])) +
                      filter_max(abs(rows[2]), abs(rows[5]));
    boxes.slack = filter_fma(size, Real(static_cast<float>(filter::box * filter::u)), shift_);
    return boxes;
  }

  struct Range {
    Real low, high;
  };
  /// The range of the boxes along an axis.
  BOULE_INLINE static Range distances(const Side& axis, const Boxes& boxes) {
    return {reach(axis, axis.near, boxes.rows) - boxes.slack,
            reach(axis, axis.far, boxes.rows) + boxes.slack};
  }
  /// The range of a, or of b, of rays that may enter the boxes; everything, or NaN, for boxes that
  /// reach behind O.
  BOULE_INLINE Range slopes(const Side& axis, const Boxes& boxes, const Range& depth) const {
    const auto [low, high] = distances(axis, boxes);
    if constexpr (common == Common::direction) {
      return {low - off_, high + off_};
    } else {
      const Real zero(0.0F), one(1.0F);
      const Real least = low * (one / select(low < zero, depth.low, depth.high));
      const Real most = high * (one / select(high < zero, depth.high, depth.low));
      const Real none(static_cast<float>(no_hit));
      const RealMask behind = depth.low <= zero;
      return {select(behind, zero - none, least - off_), select(behind, none, most + off_)};
    }
  }

  /// The same for W boxes; filter_bounds.h gives their rounding (box).
  BOULE_INLINE unsigned find_missed_part(const BvhNode& node, std::size_t part, float limit,
                                         float* near) const {
    const Boxes boxes = boxes_of(node, part);
    RealMask out = Real(0.0F) < Real(0.0F);
    for (const Side& side : sides_) {
      const Real most = reach(side, side.far, boxes.rows) + boxes.slack;
      out =
          out | (most < Real(side.offset) - abs(Real(side.offset)) *
                                                Real(static_cast<float>(filter::box * filter::u)));
    }
    const Range depth = distances(depth_, boxes);
    const Real begin = depth.low - c_high_;
    out = out | (depth.high < c_low_) | (Real(limit) < begin);
    store(near + part * width, begin);
    return bits(out);
  }

  /// The distance of a corner along the normal of a side.
  BOULE_INLINE static Real reach(const Side& side, const int (&corner)[3], const Real (&rows)[6]) {
    return filter_fma(Real(side.z), rows[corner[2]],
                      filter_fma(Real(side.y), rows[corner[1]], Real(side.x) * rows[corner[0]]));
  }

  Vec3<Real> org_;
  Real c_low_{0.0F}, c_high_{0.0F};
  Real shift_{0.0F};
  Side sides_[4], depth_;
  Side across_[2];  ///< along U and V
  Real off_;        ///< the error of a and b
};

}  // namespace boule::BOULE_KERNEL_ISA
