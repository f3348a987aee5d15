#pragma once

#include "simd/abi/bvh.h"
#include "simd/kernel/search/leaf/ray_lanes.h"

/// Ranges of a and b, the two coordinates in which a bundle's rays differ (bundle_frame.h): of some
/// of the rays, of all, or of the rays that may hit a sphere.
namespace boule::BOULE_KERNEL_ISA {

struct Extent {
  float a_low, a_high, b_low, b_high;
};

/// The extent of zero rays.
inline constexpr Extent no_extent = {static_cast<float>(no_hit), -static_cast<float>(no_hit),
                                     static_cast<float>(no_hit), -static_cast<float>(no_hit)};

BOULE_INLINE Extent extent_of_both(const Extent& a, const Extent& b) {
  return {a.a_low < b.a_low ? a.a_low : b.a_low, a.a_high > b.a_high ? a.a_high : b.a_high,
          a.b_low < b.b_low ? a.b_low : b.b_low, a.b_high > b.b_high ? a.b_high : b.b_high};
}

/// The view of a bundle on sixteen boxes: the a and b of the rays that may enter each.
struct BoxViews {
  static constexpr int size = bvh_width;
  alignas(64) float a_low[size], a_high[size], b_low[size], b_high[size];
  alignas(64) float area[size];  ///< area of the part within the extent of all rays
};

/// An extent that grows, W rays or spheres at a time.
struct ExtentLanes {
  Real a_low{static_cast<float>(no_hit)}, a_high{-static_cast<float>(no_hit)};
  Real b_low{static_cast<float>(no_hit)}, b_high{-static_cast<float>(no_hit)};

  BOULE_INLINE void add(const Real& a, const Real& b) {
    a_low = filter_min(a_low, a);
    a_high = filter_max(a_high, a);
    b_low = filter_min(b_low, b);
    b_high = filter_max(b_high, b);
  }
  /// Adds the ranges of some lanes: the first is of a, the second of b.
  BOULE_INLINE void add(const RealMask& lanes, const Real (&low)[2], const Real (&high)[2]) {
    a_low = select(lanes, filter_min(a_low, low[0]), a_low);
    a_high = select(lanes, filter_max(a_high, high[0]), a_high);
    b_low = select(lanes, filter_min(b_low, low[1]), b_low);
    b_high = select(lanes, filter_max(b_high, high[1]), b_high);
  }
  [[nodiscard]] BOULE_INLINE Extent total() const {
    return {least_lane(a_low), greatest_lane(a_high), least_lane(b_low), greatest_lane(b_high)};
  }
};

/// The index, 0 .. last, of the cell that holds or is nearest to a coordinate counted in cells; 0
/// for NaN. The caller rounds it down.
BOULE_INLINE Real cut_to_cells(const Real& x, int last) {
  const Real zero(0.0F), end(static_cast<float>(last));
  const Real low = select(zero <= x, x, zero);
  return select(low <= end, low, end);
}

}  // namespace boule::BOULE_KERNEL_ISA
