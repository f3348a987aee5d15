#pragma once

#include <cstddef>
#include <cstdint>

namespace boule::test {

inline constexpr int most_lanes = 16;

/// Operands for every lane operation; a probe uses the first `width` of each.
struct LaneInputs {
  alignas(64) float a[most_lanes], b[most_lanes], c[most_lanes];
  alignas(64) double x[most_lanes], y[most_lanes];
  alignas(64) std::uint32_t i[most_lanes], j[most_lanes];
  alignas(64) std::uint8_t bytes[most_lanes];
  alignas(64) std::uint16_t sixteen[16];  ///< always all of them
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
  alignas(64) double exponent[most_lanes], mantissa[most_lanes];  ///< of |x| and of x
  alignas(64) double power_of_two[most_lanes];                    ///< of i % 2046 - 1022
  alignas(64) std::uint32_t counted[most_lanes];                  ///< from 77 on
  alignas(64) std::uint32_t integer_sum[most_lanes], integer_product[most_lanes];
  alignas(64) std::uint32_t integer_and[most_lanes], integer_or[most_lanes],
      integer_xor[most_lanes];
  alignas(64) std::uint32_t left_shift[most_lanes], right_shift[most_lanes];  ///< of i, by 5
  alignas(64) std::uint32_t integer_select[most_lanes];  ///< i where a < b, else j
  alignas(64) std::int32_t signed_integers[most_lanes];  ///< i, through signed arrays
  alignas(64) double integer_as_wide[most_lanes];        ///< of i
  alignas(64) std::uint32_t truncated[most_lanes];       ///< the upper 24 bits of i by -4
  alignas(64) std::uint32_t reversed[most_lanes];        ///< of i, its bits
  /// From index 1 on: the lanes where a < b, of a, one after the other; the same of i, and of
  /// whether i is j; the same of x where x < y; and of |a| the halves.
  alignas(64) float chosen[most_lanes + 1];
  alignas(64) std::uint32_t chosen_integers[most_lanes + 1];
  alignas(64) std::int32_t chosen_signed[most_lanes + 1];
  std::uint8_t chosen_set[most_lanes + 1];
  alignas(64) double wide_chosen[most_lanes + 1];
  alignas(64) std::uint16_t chosen_halves[most_lanes + 1];
  /// From index 1 on: i, a and x; and what is loaded from there.
  alignas(64) std::uint32_t anywhere[most_lanes + 1], from_anywhere[most_lanes];
  alignas(64) float real_anywhere[most_lanes + 1], real_from_anywhere[most_lanes];
  alignas(64) double wide_anywhere[most_lanes + 1], wide_from_anywhere[most_lanes];
  alignas(64) float rows[4 * most_lanes];    ///< from a, b, c and a + b, lane by lane
  alignas(64) float columns[4][most_lanes];  ///< from these rows, the last one first
  unsigned less, less_equal, equal, wide_less, wide_less_equal, wide_equal;
  unsigned integer_equal, integer_less_equal, set_bytes;
  unsigned mask_and, mask_or, mask_not, wide_and, wide_or, wide_not, mask_select, widened_mask,
      narrowed_mask;
  unsigned uniform_true, uniform_false;
  std::size_t least_of_sixteen;
  bool any_less, all_less, any_none, all_all;
};

}  // namespace boule::test
