#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/platform.h"
#include "core/math/number.h"
#include "core/math/sobol.h"

/// One lane of plain float and double, with the same functions as xsimd_lanes.h, which documents
/// them: every kernel can also run, and be checked, without SIMD.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr int width = 1;

struct RealMask {
  bool m;
};
struct WideMask {
  bool m;
};

struct Real {
  float v;
  Real() = default;
  BOULE_INLINE Real(float x) : v(x) {}
};
struct Wide {
  double v;
  Wide() = default;
  BOULE_INLINE Wide(double x) : v(x) {}
};

/// An unsigned integer of 32 bits, modulo 2^32.
struct Bits {
  std::uint32_t v;
  Bits() = default;
  BOULE_INLINE explicit Bits(std::uint32_t x) : v(x) {}
  BOULE_INLINE explicit Bits(std::int32_t x) : v(static_cast<std::uint32_t>(x)) {}
};
BOULE_INLINE Bits load_integers(const std::uint32_t* p) { return Bits(*p); }
BOULE_INLINE Bits load_integers(const std::int32_t* p) { return Bits(*p); }
BOULE_INLINE void store(std::uint32_t* p, Bits a) { *p = a.v; }
BOULE_INLINE void store(std::int32_t* p, Bits a) { *p = static_cast<std::int32_t>(a.v); }
BOULE_INLINE Bits operator+(Bits a, Bits b) { return Bits(a.v + b.v); }
BOULE_INLINE Bits operator*(Bits a, Bits b) { return Bits(a.v * b.v); }
BOULE_INLINE Bits operator^(Bits a, Bits b) { return Bits(a.v ^ b.v); }
BOULE_INLINE Bits operator&(Bits a, Bits b) { return Bits(a.v & b.v); }
BOULE_INLINE Bits operator|(Bits a, Bits b) { return Bits(a.v | b.v); }
BOULE_INLINE Bits operator<<(Bits a, int by) { return Bits(a.v << by); }
BOULE_INLINE Bits operator>>(Bits a, int by) { return Bits(a.v >> by); }
BOULE_INLINE RealMask operator==(Bits a, Bits b) { return {a.v == b.v}; }
BOULE_INLINE RealMask operator<=(Bits a, Bits b) { return {a.v <= b.v}; }
BOULE_INLINE Bits select(RealMask m, Bits a, Bits b) { return m.m ? a : b; }
BOULE_INLINE Bits reverse_bits(Bits a) { return Bits(boule::detail::reverse_bits(a.v)); }
BOULE_INLINE Wide to_wide(Bits a) { return static_cast<double>(a.v); }
BOULE_INLINE Bits to_bits(Real a) { return Bits(static_cast<std::int32_t>(a.v)); }
BOULE_INLINE Bits count_from(std::uint32_t first) { return Bits(first); }

BOULE_INLINE Real load(const float* p) { return *p; }
BOULE_INLINE Wide load(const double* p) { return *p; }
BOULE_INLINE WideMask load_set(const std::uint8_t* p) { return {*p != 0}; }
BOULE_INLINE void store(double* p, Wide a) { *p = a.v; }
BOULE_INLINE void store(float* p, Real a) { *p = a.v; }
BOULE_INLINE Bits load_anywhere(const std::uint32_t* p) { return Bits(*p); }
BOULE_INLINE Real load_anywhere(const float* p) { return *p; }
BOULE_INLINE Wide load_anywhere(const double* p) { return *p; }
BOULE_INLINE void store_anywhere(float* p, Real a) { *p = a.v; }
BOULE_INLINE void store_anywhere(std::uint32_t* p, Bits a) { *p = a.v; }
BOULE_INLINE void store_chosen(float* p, Real a, unsigned) { *p = a.v; }
BOULE_INLINE void store_chosen(std::uint32_t* p, Bits a, unsigned) { *p = a.v; }
BOULE_INLINE void store_chosen(std::int32_t* p, Bits a, unsigned) {
  *p = static_cast<std::int32_t>(a.v);
}
BOULE_INLINE void store_chosen(double* p, Wide a, unsigned) { *p = a.v; }
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Real a, RealMask chosen) {
  const std::uint32_t whole = chosen.m ? std::bit_cast<std::uint32_t>(a.v) : 0xffffffffU;
  *p = static_cast<std::uint16_t>(whole << 1 >> 16);
}
BOULE_INLINE std::size_t index_of_least(const std::uint16_t* p) {
  std::size_t index = 0;
  for (std::size_t k = 1; k < 16; ++k) index = p[k] < p[index] ? k : index;
  return index;
}
struct Columns {
  Real x, y, z, w;
};
BOULE_INLINE Columns load_rows(const float* const* rows) {
  return {rows[0][0], rows[0][1], rows[0][2], rows[0][3]};
}
BOULE_INLINE void store_rows(float* p, const Columns& columns) {
  p[0] = columns.x.v;
  p[1] = columns.y.v;
  p[2] = columns.z.v;
  p[3] = columns.w.v;
}

BOULE_INLINE Real operator+(Real a, Real b) { return a.v + b.v; }
BOULE_INLINE Real operator-(Real a, Real b) { return a.v - b.v; }
BOULE_INLINE Real operator*(Real a, Real b) { return a.v * b.v; }
BOULE_INLINE Real operator/(Real a, Real b) { return a.v / b.v; }
BOULE_INLINE Wide operator+(Wide a, Wide b) { return a.v + b.v; }
BOULE_INLINE Wide operator-(Wide a, Wide b) { return a.v - b.v; }
BOULE_INLINE Wide operator*(Wide a, Wide b) { return a.v * b.v; }
BOULE_INLINE Wide operator/(Wide a, Wide b) { return a.v / b.v; }

BOULE_INLINE RealMask operator<(Real a, Real b) { return {a.v < b.v}; }
BOULE_INLINE RealMask operator<=(Real a, Real b) { return {a.v <= b.v}; }
BOULE_INLINE RealMask operator==(Real a, Real b) { return {a.v == b.v}; }
BOULE_INLINE WideMask operator<(Wide a, Wide b) { return {a.v < b.v}; }
BOULE_INLINE WideMask operator<=(Wide a, Wide b) { return {a.v <= b.v}; }
BOULE_INLINE WideMask operator==(Wide a, Wide b) { return {a.v == b.v}; }

BOULE_INLINE RealMask operator&(RealMask a, RealMask b) { return {a.m && b.m}; }
BOULE_INLINE RealMask operator|(RealMask a, RealMask b) { return {a.m || b.m}; }
BOULE_INLINE RealMask operator~(RealMask a) { return {!a.m}; }
BOULE_INLINE WideMask operator&(WideMask a, WideMask b) { return {a.m && b.m}; }
BOULE_INLINE WideMask operator|(WideMask a, WideMask b) { return {a.m || b.m}; }
BOULE_INLINE WideMask operator~(WideMask a) { return {!a.m}; }

BOULE_INLINE RealMask uniform(bool is_set) { return {is_set}; }

BOULE_INLINE unsigned bits(RealMask a) { return a.m ? 1U : 0U; }
BOULE_INLINE unsigned bits(WideMask a) { return a.m ? 1U : 0U; }

BOULE_INLINE Real select(RealMask m, Real a, Real b) { return m.m ? a : b; }
BOULE_INLINE Wide select(WideMask m, Wide a, Wide b) { return m.m ? a : b; }

BOULE_INLINE Real sqrt(Real a) { return std::sqrt(a.v); }
BOULE_INLINE Wide sqrt(Wide a) { return std::sqrt(a.v); }
BOULE_INLINE Real abs(Real a) { return std::fabs(a.v); }
BOULE_INLINE Wide abs(Wide a) { return std::fabs(a.v); }
BOULE_INLINE Wide copysign(Wide magnitude, Wide sign) { return std::copysign(magnitude.v, sign.v); }
BOULE_INLINE Wide biased_exponent(Wide a) { return boule::biased_exponent(a.v); }
BOULE_INLINE Wide mantissa(Wide a) { return boule::mantissa(a.v); }
BOULE_INLINE Wide power_of_two(Wide k) { return boule::power_of_two(k.v); }
BOULE_INLINE Real filter_fma(Real a, Real b, Real c) { return a.v * b.v + c.v; }

BOULE_INLINE Real filter_fnma(Real a, Real b, Real c) { return c.v - a.v * b.v; }

BOULE_INLINE Real filter_min(Real a, Real b) { return a.v < b.v ? a : b; }
BOULE_INLINE Real filter_max(Real a, Real b) { return a.v < b.v ? b : a; }
BOULE_INLINE Real lesser_or(Real a, Real b) { return a.v < b.v ? a : b; }
BOULE_INLINE Real greater_or(Real a, Real b) { return b.v < a.v ? a : b; }
BOULE_INLINE float least_lane(Real a) { return a.v; }
BOULE_INLINE float greatest_lane(Real a) { return a.v; }

BOULE_INLINE Wide widen(Real a) { return static_cast<double>(a.v); }
BOULE_INLINE Real narrow(Wide a) { return static_cast<float>(a.v); }
BOULE_INLINE WideMask widen(RealMask a) { return {a.m}; }
BOULE_INLINE RealMask narrow(WideMask a) { return {a.m}; }

}  // namespace boule::BOULE_KERNEL_ISA
