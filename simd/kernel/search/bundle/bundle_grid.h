#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/tuning.h"

/// A coarse map of the rays of a bundle. A sparse bundle, one with many spheres per ray, has gaps
/// between its rays, and they grow as rays get their answers. Boxes in a gap, or beyond the ends of
/// all rays around them, can be skipped.
namespace boule::BOULE_KERNEL_ISA {

class RayGrid {
 public:
  /// Enters all rays whose bit in `done` is clear, packet by packet. No ray searches beyond its v
  /// in `ends`.
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
  }

  /// The boxes among `entered`, as bits, that some ray may enter. `near`: lower bounds of the v at
  /// which rays enter each box.
  BOULE_NOINLINE unsigned meet_boxes(const BoxViews& views, const float* near,
                                     unsigned entered) const {
    BoxViews cells;
    for (int at = 0; at < BoxViews::size; at += width) {
      store(cells.a_low + at, cell(a_, load(views.a_low + at)));
      store(cells.a_high + at, cell_above(a_, load(views.a_high + at)));
      store(cells.b_low + at, cell(b_, load(views.b_low + at)));
      store(cells.b_high + at, cell_above(b_, load(views.b_high + at)));
    }
    unsigned result = 0;
    for (unsigned left = entered; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (any_in(cells.a_low[k], cells.a_high[k], cells.b_low[k], cells.b_high[k], near[k]))
        result |= 1U << k;
    }
    return result;
  }

 private:
  static constexpr int side = tuning::grid_side;
  static constexpr int coarse = tuning::grid_coarse;
  static_assert(side < 64 && side % coarse == 0);  // a row is 64 bits, and `columns` needs one more

  /// Whether there are rays in these cells, whose ends the function rounds down, and rays in the
  /// coarse cells around them that still search at `near`.
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

  void enter(int column, int row, float end) {
    rows_[row] |= std::uint64_t{1} << column;
    float& last = ends_[row / coarse][column / coarse];
    last = last < end ? end : last;  // skips NaN
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
  /// The cell of a coordinate. It is monotone in x, because rounding is. 0 for NaN.
  BOULE_INLINE static Real cell(const Axis& axis, const Real& x) {
    return cut_to_cells((x - Real(axis.low)) * Real(axis.scale), side - 1);
  }
  /// The same, but the last cell for NaN: where all rays have one coordinate, infinity times 0.
  BOULE_INLINE static Real cell_above(const Axis& axis, const Real& x) {
    const Real zero(0.0F), last(static_cast<float>(side - 1));
    const Real at = (x - Real(axis.low)) * Real(axis.scale);
    const Real low = select(at <= last, at, last);
    return select(low <= zero, zero, low);
  }

  Axis a_, b_;
  std::uint64_t rows_[side];                  ///< for each row the columns that have a ray, as bits
  float ends_[side / coarse][side / coarse];  ///< the largest end of the rays in a coarse cell
};

}  // namespace boule::BOULE_KERNEL_ISA
