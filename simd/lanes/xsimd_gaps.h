#pragma once

#include <bit>

#include "simd/lanes/xsimd_types.h"

/// Operations on floats and doubles that xsimd 8.1 lacks or gets wrong, once per instruction set:
/// masks as bits, conversions between one register of floats and two of doubles, a multiply-add
/// that is fused wherever the instruction set has one, correctly rounded division and square root,
/// min and max with a rule for NaN, rows of four floats.
namespace boule::BOULE_KERNEL_ISA::gaps {

#if defined(__AVX512F__)

BOULE_INLINE unsigned bits(FloatMask m) { return static_cast<__mmask16>(m); }
BOULE_INLINE unsigned bits(DoubleMask m) { return static_cast<__mmask8>(m); }
BOULE_INLINE DoubleMask widen_low(FloatMask m) {
  return static_cast<__mmask8>(static_cast<__mmask16>(m));
}
BOULE_INLINE DoubleMask widen_high(FloatMask m) {
  return static_cast<__mmask8>(static_cast<__mmask16>(m) >> 8);
}
BOULE_INLINE FloatMask narrow(DoubleMask lo, DoubleMask hi) {
  return static_cast<__mmask16>(bits(lo) | bits(hi) << 8);
}
BOULE_INLINE FloatMask uniform(bool is_set) { return static_cast<__mmask16>(is_set ? 0xffff : 0); }
BOULE_INLINE Doubles widen_low(Floats a) { return _mm512_cvtps_pd(_mm512_castps512_ps256(a)); }
BOULE_INLINE Doubles widen_high(Floats a) { return _mm512_cvtps_pd(_mm512_extractf32x8_ps(a, 1)); }
BOULE_INLINE Floats narrow(Doubles lo, Doubles hi) {
  const __m512 low = _mm512_castps256_ps512(_mm512_cvtpd_ps(lo));
  return _mm512_insertf32x8(low, _mm512_cvtpd_ps(hi), 1);
}
BOULE_INLINE Floats multiply_add(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
BOULE_INLINE Floats negated_multiply_add(Floats a, Floats b, Floats c) {
  return _mm512_fnmadd_ps(a, b, c);
}
BOULE_INLINE Floats divide(Floats a, Floats b) { return a / b; }
BOULE_INLINE Floats square_root(Floats a) { return xsimd::sqrt(a); }

#elif defined(__AVX2__)

BOULE_INLINE unsigned bits(FloatMask m) { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
BOULE_INLINE unsigned bits(DoubleMask m) { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
BOULE_INLINE DoubleMask widen_half(__m128 half) {
  return _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm_castps_si128(half)));
}
BOULE_INLINE DoubleMask widen_low(FloatMask m) { return widen_half(_mm256_castps256_ps128(m)); }
BOULE_INLINE DoubleMask widen_high(FloatMask m) { return widen_half(_mm256_extractf128_ps(m, 1)); }
BOULE_INLINE FloatMask narrow(DoubleMask lo, DoubleMask hi) {
  const __m256 halves = _mm256_shuffle_ps(_mm256_castpd_ps(lo), _mm256_castpd_ps(hi), 0x88);
  return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(halves), 0xd8));
}
BOULE_INLINE FloatMask uniform(bool is_set) {
  return _mm256_castsi256_ps(_mm256_set1_epi32(is_set ? -1 : 0));
}
BOULE_INLINE Doubles widen_low(Floats a) { return _mm256_cvtps_pd(_mm256_castps256_ps128(a)); }
BOULE_INLINE Doubles widen_high(Floats a) { return _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1)); }
BOULE_INLINE Floats narrow(Doubles lo, Doubles hi) {
  const __m256 low = _mm256_castps128_ps256(_mm256_cvtpd_ps(lo));
  return _mm256_insertf128_ps(low, _mm256_cvtpd_ps(hi), 1);
}
BOULE_INLINE Floats multiply_add(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
BOULE_INLINE Floats negated_multiply_add(Floats a, Floats b, Floats c) {
  return _mm256_fnmadd_ps(a, b, c);
}
BOULE_INLINE Floats divide(Floats a, Floats b) { return a / b; }
BOULE_INLINE Floats square_root(Floats a) { return xsimd::sqrt(a); }

#elif defined(__SSE4_2__)

BOULE_INLINE unsigned bits(FloatMask m) { return static_cast<unsigned>(_mm_movemask_ps(m)); }
BOULE_INLINE unsigned bits(DoubleMask m) { return static_cast<unsigned>(_mm_movemask_pd(m)); }
BOULE_INLINE DoubleMask widen_low(FloatMask m) { return _mm_castps_pd(_mm_unpacklo_ps(m, m)); }
BOULE_INLINE DoubleMask widen_high(FloatMask m) { return _mm_castps_pd(_mm_unpackhi_ps(m, m)); }
BOULE_INLINE FloatMask narrow(DoubleMask lo, DoubleMask hi) {
  return _mm_shuffle_ps(_mm_castpd_ps(lo), _mm_castpd_ps(hi), 0x88);
}
BOULE_INLINE FloatMask uniform(bool is_set) {
  return _mm_castsi128_ps(_mm_set1_epi32(is_set ? -1 : 0));
}
BOULE_INLINE Doubles widen_low(Floats a) { return _mm_cvtps_pd(a); }
BOULE_INLINE Doubles widen_high(Floats a) { return _mm_cvtps_pd(_mm_movehl_ps(a, a)); }
BOULE_INLINE Floats narrow(Doubles lo, Doubles hi) {
  return _mm_movelh_ps(_mm_cvtpd_ps(lo), _mm_cvtpd_ps(hi));
}
BOULE_INLINE Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
BOULE_INLINE Floats negated_multiply_add(Floats a, Floats b, Floats c) { return c - a * b; }
BOULE_INLINE Floats divide(Floats a, Floats b) { return a / b; }
BOULE_INLINE Floats square_root(Floats a) { return xsimd::sqrt(a); }

#else

BOULE_INLINE unsigned bits(FloatMask m) {
  constexpr std::uint32_t weight[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(m, vld1q_u32(weight)));
}
BOULE_INLINE unsigned bits(DoubleMask m) {
  constexpr std::uint64_t weight[2] = {1, 2};
  return static_cast<unsigned>(vaddvq_u64(vandq_u64(m, vld1q_u64(weight))));
}
BOULE_INLINE DoubleMask widen_low(FloatMask m) {
  return vreinterpretq_u64_s64(vmovl_s32(vget_low_s32(vreinterpretq_s32_u32(m))));
}
BOULE_INLINE DoubleMask widen_high(FloatMask m) {
  return vreinterpretq_u64_s64(vmovl_high_s32(vreinterpretq_s32_u32(m)));
}
BOULE_INLINE FloatMask narrow(DoubleMask lo, DoubleMask hi) {
  return vcombine_u32(vmovn_u64(lo), vmovn_u64(hi));
}
BOULE_INLINE FloatMask uniform(bool is_set) { return vdupq_n_u32(is_set ? 0xffffffffU : 0); }
BOULE_INLINE Doubles widen_low(Floats a) { return vcvt_f64_f32(vget_low_f32(a)); }
BOULE_INLINE Doubles widen_high(Floats a) { return vcvt_high_f64_f32(a); }
BOULE_INLINE Floats narrow(Doubles lo, Doubles hi) {
  return vcvt_high_f32_f64(vcvt_f32_f64(lo), hi);
}
BOULE_INLINE Floats multiply_add(Floats a, Floats b, Floats c) { return vfmaq_f32(c, a, b); }
BOULE_INLINE Floats negated_multiply_add(Floats a, Floats b, Floats c) {
  return vfmsq_f32(c, a, b);
}
// xsimd's own come from ARMv7: estimates and Newton steps, which are not correctly rounded.
BOULE_INLINE Floats divide(Floats a, Floats b) { return vdivq_f32(a, b); }
BOULE_INLINE Floats square_root(Floats a) { return vsqrtq_f32(a); }

#endif

// a if it is smaller (greater) than b; otherwise b, also if either is NaN. The min and max
// instructions of x86-64 do this.
#if defined(__AVX512F__)
BOULE_INLINE Floats lesser_or(Floats a, Floats b) { return _mm512_min_ps(a, b); }
BOULE_INLINE Floats greater_or(Floats a, Floats b) { return _mm512_max_ps(a, b); }
#elif defined(__AVX2__)
BOULE_INLINE Floats lesser_or(Floats a, Floats b) { return _mm256_min_ps(a, b); }
BOULE_INLINE Floats greater_or(Floats a, Floats b) { return _mm256_max_ps(a, b); }
#elif defined(__SSE4_2__)
BOULE_INLINE Floats lesser_or(Floats a, Floats b) { return _mm_min_ps(a, b); }
BOULE_INLINE Floats greater_or(Floats a, Floats b) { return _mm_max_ps(a, b); }
#else
BOULE_INLINE Floats lesser_or(Floats a, Floats b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
BOULE_INLINE Floats greater_or(Floats a, Floats b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
#endif

// The smallest and the largest lane.
#if defined(__SSE4_2__)
BOULE_INLINE float least(__m128 a) {
  const __m128 b = _mm_min_ps(a, _mm_movehl_ps(a, a));
  return _mm_cvtss_f32(_mm_min_ss(b, _mm_shuffle_ps(b, b, 1)));
}
BOULE_INLINE float greatest(__m128 a) {
  const __m128 b = _mm_max_ps(a, _mm_movehl_ps(a, a));
  return _mm_cvtss_f32(_mm_max_ss(b, _mm_shuffle_ps(b, b, 1)));
}
#endif
#if defined(__AVX2__)
BOULE_INLINE float least(__m256 a) {
  return least(_mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1)));
}
BOULE_INLINE float greatest(__m256 a) {
  return greatest(_mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1)));
}
#endif
#if defined(__AVX512F__)
BOULE_INLINE float least(Floats a) {
  return least(_mm256_min_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1)));
}
BOULE_INLINE float greatest(Floats a) {
  return greatest(_mm256_max_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1)));
}
#endif
#if defined(__aarch64__)
BOULE_INLINE float least(Floats a) { return vminvq_f32(a); }
BOULE_INLINE float greatest(Floats a) { return vmaxvq_f32(a); }
#endif

// Parts of doubles by their bits: see core/math/number.h.
using Longs = xsimd::batch<std::uint64_t, Arch>;
BOULE_INLINE Doubles biased_exponent(Doubles a) {
  const Longs whole = (std::bit_cast<Longs>(a) >> 52) | Longs(0x4330000000000000ULL);
  return std::bit_cast<Doubles>(whole) - Doubles(0x1p52);
}
BOULE_INLINE Doubles mantissa(Doubles a) {
  const Longs digits = std::bit_cast<Longs>(a) & Longs(0x000fffffffffffffULL);
  return std::bit_cast<Doubles>(digits | Longs(0x3ff0000000000000ULL));
}
BOULE_INLINE Doubles power_of_two(Doubles k) {
  return std::bit_cast<Doubles>(std::bit_cast<Longs>(k + Doubles(0x1p52 + 1023)) << 52);
}

// Rows of four floats. zip_low() and zip_high() work within each four lanes, as xsimd's do in
// version 8; in 12 and 13 those work over the whole register. load_fours() takes lanes 4k .. 4k + 3
// from p[4k], any address; store_fours() writes them to p + 16 k.
#if defined(__AVX512F__)
BOULE_INLINE Floats zip_low(Floats a, Floats b) { return _mm512_unpacklo_ps(a, b); }
BOULE_INLINE Floats zip_high(Floats a, Floats b) { return _mm512_unpackhi_ps(a, b); }
BOULE_INLINE Floats load_fours(const float* const* p) {
  Floats a = _mm512_castps128_ps512(_mm_loadu_ps(p[0]));
  a = _mm512_insertf32x4(a, _mm_loadu_ps(p[4]), 1);
  a = _mm512_insertf32x4(a, _mm_loadu_ps(p[8]), 2);
  return _mm512_insertf32x4(a, _mm_loadu_ps(p[12]), 3);
}
BOULE_INLINE void store_fours(float* p, Floats a) {
  _mm_store_ps(p, _mm512_castps512_ps128(a));
  _mm_store_ps(p + 16, _mm512_extractf32x4_ps(a, 1));
  _mm_store_ps(p + 32, _mm512_extractf32x4_ps(a, 2));
  _mm_store_ps(p + 48, _mm512_extractf32x4_ps(a, 3));
}
#elif defined(__AVX2__)
BOULE_INLINE Floats zip_low(Floats a, Floats b) { return _mm256_unpacklo_ps(a, b); }
BOULE_INLINE Floats zip_high(Floats a, Floats b) { return _mm256_unpackhi_ps(a, b); }
BOULE_INLINE Floats load_fours(const float* const* p) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[0])), _mm_loadu_ps(p[4]), 1);
}
BOULE_INLINE void store_fours(float* p, Floats a) {
  _mm_store_ps(p, _mm256_castps256_ps128(a));
  _mm_store_ps(p + 16, _mm256_extractf128_ps(a, 1));
}
#else
BOULE_INLINE Floats zip_low(Floats a, Floats b) { return xsimd::zip_lo(a, b); }
BOULE_INLINE Floats zip_high(Floats a, Floats b) { return xsimd::zip_hi(a, b); }
BOULE_INLINE Floats load_fours(const float* const* p) { return Floats::load_unaligned(p[0]); }
BOULE_INLINE void store_fours(float* p, Floats a) { a.store_aligned(p); }
#endif

}  // namespace boule::BOULE_KERNEL_ISA::gaps
