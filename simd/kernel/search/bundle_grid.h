#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle_rays.h"

/// Where a bundle's rays are, coarsely. Rays that are fewer than the spheres around them leave gaps
/// between each other, and more so as they meet things and are done: what lies in a gap, or beyond
/// the ends of the rays around, need not be visited.
namespace boule::BOULE_KERNEL_ISA {

class RayGrid {
 public:
  /// Nothing is known before it is filled.
  [[nodiscard]] bool known() const { return known_; }

  /// Enters the rays but those that `done` has a bit for, packet by packet. `ends`: no ray lives
  /// beyond that v.
  BOULE_NOINLINE void fill(const BundleRays& rays, const unsigned* done, const float* ends) {
    a_ = axis(rays.extent.a_low, rays.extent.a_high);
    b_ = axis(rays.extent.b_low, rays.extent.b_high);
    for (std::uint64_t& row : rows_) row = 0;
    for (auto& ends_of_row : ends_) {
      for (float& end : ends_of_row) end = -static_cast<float>(no_hit);
    }
    alignas(64) float column[width], row[width];
    for (int p = 0; p < rays.packets; ++p) {
      if (done[p] == all_lanes) continue;
      store(column, cell(a_, load(rays.a + p * width)));
      store(row, cell(b_, load(rays.b + p * width)));
      for (unsigned left = all_lanes & ~done[p]; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        enter(static_cast<int>(column[lane]), static_cast<int>(row[lane]), ends[p * width + lane]);
      }
    }
    known_ = true;
  }

  /// Lanes of W ranges of a and b, NaN for unknown.
  struct Cells {
    Real a_low, a_high, b_low, b_high;
  };
  BOULE_INLINE Cells cells(const Real& a_low, const Real& a_high, const Real& b_low,
                           const Real& b_high) const {
    return {cell(a_, a_low), cell_above(a_, a_high), cell(b_, b_low), cell_above(b_, b_high)};
  }

  /// Whether there are rays in these cells, and some around that live at and beyond `near`.
  [[nodiscard]] bool any_in(float a_low, float a_high, float b_low, float b_high,
                            float near) const {
    const int left = static_cast<int>(a_low), right = static_cast<int>(a_high);
    const int begin = static_cast<int>(b_low), end = static_cast<int>(b_high);
    const std::uint64_t columns = (std::uint64_t{2} << right) - (std::uint64_t{1} << left);
    for (int row = begin; row <= end; ++row) {
      if ((rows_[row] & columns) != 0) return any_lives(left, right, begin, end, near);
    }
    return false;
  }

 private:
  static constexpr int side = 32;
  /// Ends are kept for so many cells, squared, together.
  static constexpr int coarse = 4;

  void enter(int column, int row, float end) {
    rows_[row] |= std::uint64_t{1} << column;
    float& last = ends_[row / coarse][column / coarse];
    last = last < end ? end : last;  // NaN is left out
  }
  BOULE_INLINE bool any_lives(int left, int right, int begin, int end, float near) const {
    for (int row = begin / coarse; row <= end / coarse; ++row) {
      for (int column = left / coarse; column <= right / coarse; ++column) {
        if (!(ends_[row][column] < near)) return true;
      }
    }
    return false;
  }

  struct Axis {
    float low, scale;
  };
  static Axis axis(float low, float high) {
    return {low, high > low ? static_cast<float>(side) / (high - low) : 0.0F};
  }
  /// Rises with x, as the roundings do; 0 for NaN.
  BOULE_INLINE static Real cell(const Axis& axis, const Real& x) {
    return cut_to_cells((x - Real(axis.low)) * Real(axis.scale), side - 1);
  }
  /// The same, but the last for NaN.
  BOULE_INLINE static Real cell_above(const Axis& axis, const Real& x) {
    const Real zero(0.0F), last(static_cast<float>(side - 1));
    const Real at = (x - Real(axis.low)) * Real(axis.scale);
    const Real low = select(at <= last, at, last);
    return select(low <= zero, zero, low);
  }

  bool known_ = false;
  Axis a_, b_;
  std::uint64_t rows_[side];
  float ends_[side / coarse][side / coarse];
};

}  // namespace boule::BOULE_KERNEL_ISA
