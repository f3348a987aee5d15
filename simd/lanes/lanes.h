#pragma once

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

BOULE_INLINE WideMask complement(const WideMask& m) { return ~m; }
BOULE_INLINE RealMask complement(const RealMask& m) { return ~m; }

}  // namespace boule::BOULE_KERNEL_ISA
