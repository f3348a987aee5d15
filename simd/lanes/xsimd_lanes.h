#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/lanes/xsimd_compress.h"
#include "simd/lanes/xsimd_gaps.h"
#include "simd/lanes/xsimd_integers.h"

/// W lanes over xsimd, where W is `width`. Real is a register of floats, Bits one of integers, and
/// Wide two registers that hold the same lanes in double. + - * / and sqrt are correctly rounded
/// and never fused. Addresses are aligned to the register unless a function says otherwise.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr int width = static_cast<int>(Floats::size);

// All lanes are copied by registers: GCC 12 would copy structs of them piece by piece, through
// memory.

struct RealMask {
  FloatMask m;
  RealMask() = default;
  BOULE_INLINE RealMask(FloatMask a) : m(a) {}
  BOULE_INLINE RealMask(const RealMask& a) : m(a.m.data) {}
  BOULE_INLINE RealMask& operator=(const RealMask& a) {
    m.data = a.m.data;
    return *this;
  }
};
struct WideMask {
  DoubleMask lo, hi;
  WideMask() = default;
  BOULE_INLINE WideMask(DoubleMask l, DoubleMask h) : lo(l), hi(h) {}
  BOULE_INLINE WideMask(const WideMask& a) : lo(a.lo.data), hi(a.hi.data) {}
  BOULE_INLINE WideMask& operator=(const WideMask& a) {
    lo.data = a.lo.data;
    hi.data = a.hi.data;
    return *this;
  }
};

struct Real {
  Floats v;
  Real() = default;
  BOULE_INLINE Real(const Real& a) : v(a.v.data) {}
  BOULE_INLINE Real& operator=(const Real& a) {
    v.data = a.v.data;
    return *this;
  }
  BOULE_INLINE Real(float x) : v(x) {}
  BOULE_INLINE Real(Floats x) : v(x) {}
};
struct Wide {
  Doubles lo, hi;
  Wide() = default;
  BOULE_INLINE Wide(const Wide& a) : lo(a.lo.data), hi(a.hi.data) {}
  BOULE_INLINE Wide& operator=(const Wide& a) {
    lo.data = a.lo.data;
    hi.data = a.hi.data;
    return *this;
  }
  BOULE_INLINE Wide(double x) : lo(x), hi(x) {}
  BOULE_INLINE Wide(Doubles l, Doubles h) : lo(l), hi(h) {}
};

/// Unsigned integers of 32 bits, modulo 2^32. Their comparisons give the masks of floats.
struct Bits {
  Integers v;
  Bits() = default;
  BOULE_INLINE Bits(const Bits& a) : v(a.v.data) {}
  BOULE_INLINE Bits& operator=(const Bits& a) {
    v.data = a.v.data;
    return *this;
  }
  BOULE_INLINE explicit Bits(std::uint32_t x) : v(x) {}
  BOULE_INLINE explicit Bits(std::int32_t x) : v(static_cast<std::uint32_t>(x)) {}
  BOULE_INLINE Bits(Integers x) : v(x) {}
};
BOULE_INLINE Bits load_integers(const std::uint32_t* p) { return Integers::load_aligned(p); }
BOULE_INLINE Bits load_integers(const std::int32_t* p) {
  return Integers::load_aligned(reinterpret_cast<const std::uint32_t*>(p));
}
BOULE_INLINE void store(std::uint32_t* p, Bits a) { a.v.store_aligned(p); }
BOULE_INLINE void store(std::int32_t* p, Bits a) {
  a.v.store_aligned(reinterpret_cast<std::uint32_t*>(p));
}
BOULE_INLINE Bits operator+(Bits a, Bits b) { return a.v + b.v; }
BOULE_INLINE Bits operator*(Bits a, Bits b) { return a.v * b.v; }
BOULE_INLINE Bits operator^(Bits a, Bits b) { return a.v ^ b.v; }
BOULE_INLINE Bits operator&(Bits a, Bits b) { return a.v & b.v; }
BOULE_INLINE Bits operator|(Bits a, Bits b) { return a.v | b.v; }
BOULE_INLINE Bits operator<<(Bits a, int by) { return a.v << by; }
BOULE_INLINE Bits operator>>(Bits a, int by) { return a.v >> by; }
BOULE_INLINE RealMask operator==(Bits a, Bits b) { return {gaps::equal(a.v, b.v)}; }
BOULE_INLINE RealMask operator<=(Bits a, Bits b) { return {gaps::at_most(a.v, b.v)}; }
BOULE_INLINE Bits select(RealMask m, Bits a, Bits b) { return gaps::select(m.m, a.v, b.v); }
/// The bits of each integer in reverse order.
BOULE_INLINE Bits reverse_bits(Bits a) { return gaps::reverse_bits(a.v); }
/// Exactly.
BOULE_INLINE Wide to_wide(Bits a) { return {gaps::to_double_low(a.v), gaps::to_double_high(a.v)}; }
/// Towards zero. Precondition: a is in the range of std::int32_t.
BOULE_INLINE Bits to_bits(const Real& a) { return gaps::to_integers(a.v); }
/// first, first + 1, ...
BOULE_INLINE Bits count_from(std::uint32_t first) { return Integers(first) + gaps::counted(); }

BOULE_INLINE Real load(const float* p) { return Floats::load_aligned(p); }
BOULE_INLINE Wide load(const double* p) {
  return {Doubles::load_aligned(p), Doubles::load_aligned(p + width / 2)};
}
/// The lanes whose byte is not 0.
BOULE_INLINE WideMask load_set(const std::uint8_t* p) {
  return {gaps::load_set(p), gaps::load_set(p + width / 2)};
}
BOULE_INLINE void store(float* p, Real a) { a.v.store_aligned(p); }
BOULE_INLINE void store(double* p, Wide a) {
  a.lo.store_aligned(p);
  a.hi.store_aligned(p + width / 2);
}
/// From any address, and to any.
BOULE_INLINE Bits load_anywhere(const std::uint32_t* p) { return Integers::load_unaligned(p); }
BOULE_INLINE Real load_anywhere(const float* p) { return Floats::load_unaligned(p); }
BOULE_INLINE Wide load_anywhere(const double* p) {
  return {Doubles::load_unaligned(p), Doubles::load_unaligned(p + width / 2)};
}
BOULE_INLINE void store_anywhere(float* p, Real a) { a.v.store_unaligned(p); }
BOULE_INLINE void store_anywhere(std::uint32_t* p, Bits a) { a.v.store_unaligned(p); }
/// Packs the lanes whose bit is set in `chosen`, at any address. Writes W numbers, of which those
/// after the chosen ones are undefined.
BOULE_INLINE void store_chosen(float* p, Real a, unsigned chosen) {
  gaps::store_chosen(p, a.v, chosen);
}
BOULE_INLINE void store_chosen(std::uint32_t* p, Bits a, unsigned chosen) {
  gaps::store_chosen(p, a.v, chosen);
}
BOULE_INLINE void store_chosen(std::int32_t* p, Bits a, unsigned chosen) {
  gaps::store_chosen(reinterpret_cast<std::uint32_t*>(p), a.v, chosen);
}
BOULE_INLINE void store_chosen(double* p, Wide a, unsigned chosen) {
  const unsigned lo = chosen & ((1U << (width / 2)) - 1);
  gaps::store_chosen(p, a.lo, lo);
  gaps::store_chosen(p + __builtin_popcount(lo), a.hi, chosen >> (width / 2));
}
/// Of floats that are at least 0, the upper 16 bits behind the sign, which are in the floats'
/// order: those of the lanes `chosen` packed, and then 0xffff up to W.
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Real a, RealMask chosen) {
  gaps::store_chosen_halves(p, a.v, chosen.m);
}
/// The index of the smallest of 16 numbers, of equal ones any. `p` is aligned to 32 bytes.
BOULE_INLINE std::size_t index_of_least(const std::uint16_t* p) { return gaps::index_of_least(p); }

/// W rows of four floats as columns; row k is lane k.
struct Columns {
  Real x, y, z, w;
};
/// Makes rows of columns, and columns of rows, within each four lanes.
BOULE_INLINE Columns transpose(const Columns& c) {
  const Floats xz = gaps::zip_low(c.x.v, c.z.v), yw = gaps::zip_low(c.y.v, c.w.v);
  const Floats xz_high = gaps::zip_high(c.x.v, c.z.v), yw_high = gaps::zip_high(c.y.v, c.w.v);
  return {gaps::zip_low(xz, yw), gaps::zip_high(xz, yw), gaps::zip_low(xz_high, yw_high),
          gaps::zip_high(xz_high, yw_high)};
}
/// `rows` has a pointer for each of W rows, to any address.
BOULE_INLINE Columns load_rows(const float* const* rows) {
  return transpose({gaps::load_fours(rows), gaps::load_fours(rows + 1), gaps::load_fours(rows + 2),
                    gaps::load_fours(rows + 3)});
}
/// The rows follow each other in memory. `p` is aligned to 16 bytes.
BOULE_INLINE void store_rows(float* p, const Columns& columns) {
  const Columns rows = transpose(columns);
  gaps::store_fours(p, rows.x.v);
  gaps::store_fours(p + 4, rows.y.v);
  gaps::store_fours(p + 8, rows.z.v);
  gaps::store_fours(p + 12, rows.w.v);
}

BOULE_INLINE Real operator+(Real a, Real b) { return a.v + b.v; }
BOULE_INLINE Real operator-(Real a, Real b) { return a.v - b.v; }
BOULE_INLINE Real operator*(Real a, Real b) { return a.v * b.v; }
BOULE_INLINE Real operator/(Real a, Real b) { return gaps::divide(a.v, b.v); }
BOULE_INLINE Wide operator+(Wide a, Wide b) { return {a.lo + b.lo, a.hi + b.hi}; }
BOULE_INLINE Wide operator-(Wide a, Wide b) { return {a.lo - b.lo, a.hi - b.hi}; }
BOULE_INLINE Wide operator*(Wide a, Wide b) { return {a.lo * b.lo, a.hi * b.hi}; }
BOULE_INLINE Wide operator/(Wide a, Wide b) { return {a.lo / b.lo, a.hi / b.hi}; }

// Ordered comparisons: false where either side is NaN.
BOULE_INLINE RealMask operator<(Real a, Real b) { return {a.v < b.v}; }
BOULE_INLINE RealMask operator<=(Real a, Real b) { return {a.v <= b.v}; }
BOULE_INLINE RealMask operator==(Real a, Real b) { return {a.v == b.v}; }
BOULE_INLINE WideMask operator<(Wide a, Wide b) { return {a.lo < b.lo, a.hi < b.hi}; }
BOULE_INLINE WideMask operator<=(Wide a, Wide b) { return {a.lo <= b.lo, a.hi <= b.hi}; }
BOULE_INLINE WideMask operator==(Wide a, Wide b) { return {a.lo == b.lo, a.hi == b.hi}; }

BOULE_INLINE RealMask operator&(RealMask a, RealMask b) { return {a.m & b.m}; }
BOULE_INLINE RealMask operator|(RealMask a, RealMask b) { return {a.m | b.m}; }
BOULE_INLINE RealMask operator~(RealMask a) { return {~a.m}; }
BOULE_INLINE WideMask operator&(WideMask a, WideMask b) { return {a.lo & b.lo, a.hi & b.hi}; }
BOULE_INLINE WideMask operator|(WideMask a, WideMask b) { return {a.lo | b.lo, a.hi | b.hi}; }
BOULE_INLINE WideMask operator~(WideMask a) { return {~a.lo, ~a.hi}; }

/// The same in every lane.
BOULE_INLINE RealMask uniform(bool is_set) { return {gaps::uniform(is_set)}; }

/// Bit k is set if lane k is.
BOULE_INLINE unsigned bits(RealMask a) { return gaps::bits(a.m); }
BOULE_INLINE unsigned bits(WideMask a) {
  return gaps::bits(a.lo) | (gaps::bits(a.hi) << (width / 2));
}

BOULE_INLINE Real select(RealMask m, Real a, Real b) { return xsimd::select(m.m, a.v, b.v); }
BOULE_INLINE Wide select(WideMask m, Wide a, Wide b) {
  return {xsimd::select(m.lo, a.lo, b.lo), xsimd::select(m.hi, a.hi, b.hi)};
}

BOULE_INLINE Real sqrt(Real a) { return gaps::square_root(a.v); }
BOULE_INLINE Wide sqrt(Wide a) { return {xsimd::sqrt(a.lo), xsimd::sqrt(a.hi)}; }
BOULE_INLINE Real abs(Real a) { return xsimd::abs(a.v); }
BOULE_INLINE Wide abs(Wide a) { return {xsimd::abs(a.lo), xsimd::abs(a.hi)}; }
BOULE_INLINE Wide copysign(Wide magnitude, Wide sign) {
  return {xsimd::copysign(magnitude.lo, sign.lo), xsimd::copysign(magnitude.hi, sign.hi)};
}

// Parts of doubles by their bits: as in core/math/number.h.
BOULE_INLINE Wide biased_exponent(Wide a) {
  return {gaps::biased_exponent(a.lo), gaps::biased_exponent(a.hi)};
}
BOULE_INLINE Wide mantissa(Wide a) { return {gaps::mantissa(a.lo), gaps::mantissa(a.hi)}; }
BOULE_INLINE Wide power_of_two(Wide k) {
  return {gaps::power_of_two(k.lo), gaps::power_of_two(k.hi)};
}

/// a b + c and c - a b, fused where the instruction set can. They are for filters and for the fast
/// solver only, because their bits differ between instruction sets.
BOULE_INLINE Real filter_fma(Real a, Real b, Real c) { return gaps::multiply_add(a.v, b.v, c.v); }
BOULE_INLINE Real filter_fnma(Real a, Real b, Real c) {
  return gaps::negated_multiply_add(a.v, b.v, c.v);
}

/// The smaller and the greater of two numbers, neither of them NaN.
BOULE_INLINE Real filter_min(Real a, Real b) { return xsimd::min(a.v, b.v); }
BOULE_INLINE Real filter_max(Real a, Real b) { return xsimd::max(a.v, b.v); }
/// a if it is smaller (greater) than b; otherwise b, also if either is NaN.
BOULE_INLINE Real lesser_or(Real a, Real b) { return gaps::lesser_or(a.v, b.v); }
BOULE_INLINE Real greater_or(Real a, Real b) { return gaps::greater_or(a.v, b.v); }
/// The smallest and the largest lane. Precondition: no lane is NaN.
BOULE_INLINE float least_lane(Real a) { return gaps::least(a.v); }
BOULE_INLINE float greatest_lane(Real a) { return gaps::greatest(a.v); }

BOULE_INLINE Wide widen(Real a) { return {gaps::widen_low(a.v), gaps::widen_high(a.v)}; }
BOULE_INLINE WideMask widen(RealMask a) { return {gaps::widen_low(a.m), gaps::widen_high(a.m)}; }
BOULE_INLINE RealMask narrow(WideMask a) { return {gaps::narrow(a.lo, a.hi)}; }

/// Rounded to nearest.
BOULE_INLINE Real narrow(Wide a) { return gaps::narrow(a.lo, a.hi); }

}  // namespace boule::BOULE_KERNEL_ISA
