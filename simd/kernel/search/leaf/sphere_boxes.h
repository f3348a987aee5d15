#pragma once

#include "simd/kernel/search/leaf/ray_lanes.h"

/// The boxes around a block's spheres, for beams and reach boxes: wider than the spheres, by the
/// rounding error of float. docs/numerics.md derives the margin (filter::beam).
namespace boule::BOULE_KERNEL_ISA {

class SphereBoxes {
 public:
  /// `extent`: BvhView::extent.
  BOULE_INLINE explicit SphereBoxes(float extent)
      : slack_(extent * static_cast<float>(filter::beam * filter::u) +
               static_cast<float>(2 * filter::floor)) {}
  SphereBoxes() = default;

  /// Half the sizes of W boxes, from the radii of their spheres.
  [[nodiscard]] BOULE_INLINE Real half_sizes(const float* radii) const {
    const Real outward(static_cast<float>(1 + filter::beam * filter::u));
    return filter_fma(abs(load(radii)), outward, Real(slack_));
  }

 private:
  float slack_;
};

}  // namespace boule::BOULE_KERNEL_ISA
