#pragma once

#include <cstddef>

#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/search/leaf/sphere_boxes.h"

/// The box around the reach of a packet's rays, from their origins to their ends. All rays miss the
/// primitives outside it. Six comparisons test sixteen boxes, or the boxes of sixteen spheres,
/// whatever the rays' directions. Chosen for any hit where the rays are short (ambient occlusion):
/// in trees where they form no beam, and in scans without a tree. docs/numerics.md derives the
/// slack (filter::reach).
namespace boule::BOULE_KERNEL_ISA {

class ReachBox {
 public:
  /// `far`: the largest t |dir| that counts. `extent`: BvhView::extent.
  BOULE_INLINE ReachBox(const FilterRays& rays, const Real& far, float extent) : boxes_(extent) {
    is_short_ = all(is_judged(rays) & (Real(0.0F) <= far) & (far < Real(extent)));
    if (!is_short_) return;
    set(0, rays.org.x, rays.unit.x, far);
    set(1, rays.org.y, rays.unit.y, far);
    set(2, rays.org.z, rays.unit.z, far);
  }
  /// Whether the rays are short. Precondition of all other functions: they are.
  [[nodiscard]] BOULE_INLINE bool is_short() const { return is_short_; }

  /// Grows to hold `other` too, unless the sum of its sides would exceed `most` times that of the
  /// larger box. Returns whether it grew. Precondition: both are short.
  BOULE_INLINE bool grow(const ReachBox& other, float most) {
    float low[3], high[3], sides = 0, first = 0, second = 0;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = low_[axis] < other.low_[axis] ? low_[axis] : other.low_[axis];
      high[axis] = high_[axis] < other.high_[axis] ? other.high_[axis] : high_[axis];
      sides += high[axis] - low[axis];
      first += high_[axis] - low_[axis];
      second += other.high_[axis] - other.low_[axis];
    }
    if (most * (first < second ? second : first) < sides) return false;
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = low[axis];
      high_[axis] = high[axis];
    }
    return true;
  }

  /// The children of a node within reach, as bits.
  [[nodiscard]] BOULE_INLINE unsigned enter(const BvhNode& node) const {
    unsigned in = 0;
    for (std::size_t at = 0; at < bvh_width; at += width) {
      const auto out = [at](const float* row_low, const float* row_high, float low, float high) {
        return (load(row_high + at) < Real(low)) | (Real(high) < load(row_low + at));
      };
      in |= bits(~(out(node.min_x, node.max_x, low_[0], high_[0]) |
                   out(node.min_y, node.max_y, low_[1], high_[1]) |
                   out(node.min_z, node.max_z, low_[2], high_[2])))
            << at;
    }
    return in;
  }
  /// The spheres of a leaf, or another block, whose boxes are within reach, as bits.
  [[nodiscard]] BOULE_INLINE unsigned meet(const SphereBlock& leaf) const {
    unsigned in = 0;
    for (std::size_t at = 0; at < bvh_leaf_size; at += width) {
      const Real r = boxes_.half_sizes(leaf.radius + at);
      const auto out = [&](const float* row, float low, float high) {
        const Real center = load(row + at);
        return (center + r < Real(low)) | (Real(high) < center - r);
      };
      in |= bits(~(out(leaf.center_x, low_[0], high_[0]) | out(leaf.center_y, low_[1], high_[1]) |
                   out(leaf.center_z, low_[2], high_[2])))
            << at;
    }
    return in;
  }

 private:
  BOULE_INLINE void set(int axis, const Real& org, const Real& unit, const Real& far) {
    const Real end = filter_fma(unit, far, org);
    const Real slack =
        filter_fma(abs(org) + far, Real(static_cast<float>(filter::reach * filter::u)),
                   Real(static_cast<float>(filter::floor)));
    low_[axis] = least_lane(filter_min(org, end) - slack);
    high_[axis] = greatest_lane(filter_max(org, end) + slack);
  }

  float low_[3], high_[3];
  SphereBoxes boxes_;
  bool is_short_;
};

}  // namespace boule::BOULE_KERNEL_ISA
