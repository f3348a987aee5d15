#pragma once

namespace boule::test {

inline constexpr int most_lanes = 16;

/// Operands for every lane operation; a probe uses the first `width` of each.
struct LaneInputs {
  alignas(64) float a[most_lanes], b[most_lanes], c[most_lanes];
  alignas(64) double x[most_lanes], y[most_lanes];
};

/// Results, one array an operation. Masks come as bits.
struct LaneOutputs {
  int width;
  alignas(64) float add[most_lanes], sub[most_lanes], mul[most_lanes], div[most_lanes];
  alignas(64) float sqrt[most_lanes], abs[most_lanes], fma[most_lanes], fnma[most_lanes],
      select[most_lanes];
  alignas(64) float narrow[most_lanes];
  alignas(64) double wide_add[most_lanes], wide_sub[most_lanes], wide_mul[most_lanes];
  alignas(64) double wide_div[most_lanes], wide_sqrt[most_lanes], wide_abs[most_lanes];
  alignas(64) double wide_copysign[most_lanes], wide_select[most_lanes], widen[most_lanes];
  alignas(64) double lane_numbers[most_lanes];
  alignas(64) float counted[most_lanes];  ///< bits of 77 and on
  /// The lanes where a < b of a, one after the other, from place 1 on; then -1.
  alignas(64) float chosen[most_lanes + 1], chosen_or[most_lanes + 1];
  alignas(64) double wide_chosen[most_lanes + 1];  ///< the same of x where x < y
  alignas(64) float rows[4 * most_lanes];          ///< from a, b, c and a + b, lane by lane
  alignas(64) float columns[4][most_lanes];        ///< from these rows, the last one first
  unsigned less, less_equal, equal_integers, wide_less, wide_less_equal, wide_equal;
  unsigned mask_and, mask_or, mask_not, wide_and, wide_or, wide_not, widened_mask;
  bool any_less, all_less, any_none, all_all;
};

}  // namespace boule::test
