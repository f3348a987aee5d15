#pragma once

#include <cstddef>
#include <cstdint>

// The lane types of one instruction set, in a namespace of their own:
//   Real   `width` floats            Bits   as many integers of 32 bits
//   Wide   the same lanes in double  RealMask, WideMask   the lanes in which something is true
// Comments call the number of lanes, `width`, W. A kernel is written once over these types; the
// build compiles it once per instruction set.
#ifdef BOULE_KERNEL_SCALAR
#include "simd/lanes/scalar_lanes.h"
#else
#include "simd/lanes/xsimd_lanes.h"
#endif

namespace boule::BOULE_KERNEL_ISA {

/// The bits of a mask that is true in every lane.
inline constexpr unsigned all_lanes = (1U << width) - 1;

/// The bits of the first `count` lanes, or of all if there are fewer.
BOULE_INLINE unsigned first_lanes(std::size_t count) {
  return count < static_cast<std::size_t>(width) ? (1U << count) - 1 : all_lanes;
}

/// The number of set bits. Without an instruction for it, std::popcount() of a whole word would
/// call a library function, which is forbidden in kernels.
BOULE_INLINE int count_bits(unsigned bits) {
#ifdef __POPCNT__
  return __builtin_popcount(bits);
#endif
  bits -= bits >> 1 & 0x55555555U;
  bits = (bits & 0x33333333U) + (bits >> 2 & 0x33333333U);
  return static_cast<int>(((bits + (bits >> 4)) & 0x0f0f0f0fU) * 0x01010101U >> 24);
}

template <class Mask>
BOULE_INLINE bool any(Mask m) {
  return bits(m) != 0;
}
template <class Mask>
BOULE_INLINE bool all(Mask m) {
  return bits(m) == all_lanes;
}

BOULE_INLINE WideMask select(const WideMask& m, const WideMask& a, const WideMask& b) {
  return (m & a) | (~m & b);
}
BOULE_INLINE RealMask select(const RealMask& m, const RealMask& a, const RealMask& b) {
  return (m & a) | (~m & b);
}

/// Packs the lanes whose bit is set in `chosen`: 1 where `set` is, otherwise 0. Writes W bytes, of
/// which those after the chosen ones are undefined.
BOULE_INLINE void store_chosen(std::uint8_t* p, const RealMask& set, unsigned chosen) {
  const unsigned ones = bits(set) & chosen;
  for (int lane = 0; lane < width; ++lane) p[lane] = 0;
  if (ones == 0) return;  // as nearly always
  for (; chosen != 0; chosen &= chosen - 1) *p++ = ones >> __builtin_ctz(chosen) & 1U;
}

BOULE_INLINE WideMask complement(const WideMask& m) { return ~m; }
BOULE_INLINE RealMask complement(const RealMask& m) { return ~m; }

}  // namespace boule::BOULE_KERNEL_ISA
