#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "core/base/platform.h"

/// What xsimd 8.1 lacks or gets wrong, once per instruction set: mask bits, float <-> double of a
/// whole register, a multiply-add that is fused wherever the ISA can, correctly rounded
/// division and square root.
namespace boule::BOULE_KERNEL_ISA {

#if defined(__AVX512F__)
using Arch = xsimd::avx512bw;
#elif defined(__AVX2__)
using Arch = xsimd::fma3<xsimd::avx2>;
#elif defined(__SSE4_2__)
using Arch = xsimd::sse4_2;
#else
using Arch = xsimd::neon64;
#endif

using Floats = xsimd::batch<float, Arch>;
using Doubles = xsimd::batch<double, Arch>;
using Integers = xsimd::batch<std::uint32_t, Arch>;
using FloatMask = xsimd::batch_bool<float, Arch>;
using DoubleMask = xsimd::batch_bool<double, Arch>;

namespace gaps {

#if defined(__AVX512F__)

BOULE_INLINE unsigned bits(FloatMask m) { return static_cast<__mmask16>(m); }
BOULE_INLINE unsigned bits(DoubleMask m) { return static_cast<__mmask8>(m); }
BOULE_INLINE DoubleMask widen_low(FloatMask m) {
  return static_cast<__mmask8>(static_cast<__mmask16>(m));
}
BOULE_INLINE DoubleMask widen_high(FloatMask m) {
  return static_cast<__mmask8>(static_cast<__mmask16>(m) >> 8);
}
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
BOULE_INLINE Doubles widen_low(Floats a) { return vcvt_f64_f32(vget_low_f32(a)); }
BOULE_INLINE Doubles widen_high(Floats a) { return vcvt_high_f64_f32(a); }
BOULE_INLINE Floats narrow(Doubles lo, Doubles hi) {
  return vcvt_high_f32_f64(vcvt_f32_f64(lo), hi);
}
BOULE_INLINE Floats multiply_add(Floats a, Floats b, Floats c) { return vfmaq_f32(c, a, b); }
BOULE_INLINE Floats negated_multiply_add(Floats a, Floats b, Floats c) {
  return vfmsq_f32(c, a, b);
}
// xsimd's own are ARMv7's: estimates and Newton steps, not correctly rounded.
BOULE_INLINE Floats divide(Floats a, Floats b) { return vdivq_f32(a, b); }
BOULE_INLINE Floats square_root(Floats a) { return vsqrtq_f32(a); }

#endif

// The smaller and the greater of two, else the second: one instruction on x86-64.
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

// The least and the greatest lane.
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

// Any 32 bits, from arrays of integers.
#if defined(__AVX512F__)
BOULE_INLINE Floats load_bits(const std::uint32_t* p) {
  return _mm512_castsi512_ps(_mm512_load_si512(p));
}
#elif defined(__AVX2__)
BOULE_INLINE Floats load_bits(const std::uint32_t* p) {
  return _mm256_castsi256_ps(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)));
}
#elif defined(__SSE4_2__)
BOULE_INLINE Floats load_bits(const std::uint32_t* p) {
  return _mm_castsi128_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
}
#else
BOULE_INLINE Floats load_bits(const std::uint32_t* p) {
  return vreinterpretq_f32_u32(vld1q_u32(p));
}
#endif

// `first`, first + 1, ... as bits; and the lanes in which integers are equal to one.
#if defined(__AVX512F__)
BOULE_INLINE Floats count_from(std::uint32_t first) {
  const __m512i steps = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  return _mm512_castsi512_ps(_mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), steps));
}
BOULE_INLINE FloatMask equal(const std::int32_t* p, std::int32_t value) {
  return _mm512_cmpeq_epi32_mask(_mm512_load_si512(p), _mm512_set1_epi32(value));
}
#elif defined(__AVX2__)
BOULE_INLINE Floats count_from(std::uint32_t first) {
  const __m256i steps = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), steps));
}
BOULE_INLINE FloatMask equal(const std::int32_t* p, std::int32_t value) {
  const __m256i numbers = _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(numbers, _mm256_set1_epi32(value)));
}
#elif defined(__SSE4_2__)
BOULE_INLINE Floats count_from(std::uint32_t first) {
  const __m128i steps = _mm_setr_epi32(0, 1, 2, 3);
  return _mm_castsi128_ps(_mm_add_epi32(_mm_set1_epi32(static_cast<int>(first)), steps));
}
BOULE_INLINE FloatMask equal(const std::int32_t* p, std::int32_t value) {
  const __m128i numbers = _mm_load_si128(reinterpret_cast<const __m128i*>(p));
  return _mm_castsi128_ps(_mm_cmpeq_epi32(numbers, _mm_set1_epi32(value)));
}
#else
BOULE_INLINE Floats count_from(std::uint32_t first) {
  constexpr std::uint32_t steps[4] = {0, 1, 2, 3};
  return vreinterpretq_f32_u32(vaddq_u32(vdupq_n_u32(first), vld1q_u32(steps)));
}
BOULE_INLINE FloatMask equal(const std::int32_t* p, std::int32_t value) {
  return vceqq_s32(vld1q_s32(p), vdupq_n_s32(value));
}
#endif

// The lanes of `chosen`, one after the other, to any address; W floats are written: behind them
// anything, or lanes of `rest`, the same in all.
#if defined(__AVX512F__)
BOULE_INLINE void store_chosen(float* p, Floats a, unsigned chosen) {
  _mm512_storeu_ps(p, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a));
}
BOULE_INLINE void store_chosen(float* p, Floats a, FloatMask chosen, Floats rest) {
  _mm512_storeu_ps(p, _mm512_mask_compress_ps(rest, chosen, a));
}
BOULE_INLINE void store_chosen(double* p, Doubles a, unsigned chosen) {
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(static_cast<__mmask8>(chosen), a));
}
#else
#if defined(__AVX2__)
/// For every set of eight lanes their numbers, one after the other, and then the others', a byte
/// each.
struct ChosenLanes {
  std::uint64_t of[256];
};
constexpr ChosenLanes list_chosen_lanes() {
  ChosenLanes lanes{};
  for (unsigned chosen = 0; chosen < 256; ++chosen) {
    unsigned count = 0;
    for (const unsigned set : {chosen, ~chosen}) {
      for (std::uint64_t lane = 0; lane < 8; ++lane) {
        if ((set >> lane & 1U) != 0) lanes.of[chosen] |= lane << (8 * count++);
      }
    }
  }
  return lanes;
}
inline constexpr ChosenLanes chosen_lanes = list_chosen_lanes();
BOULE_INLINE Floats chosen_first(Floats a, unsigned chosen) {
  const __m128i lanes = _mm_cvtsi64_si128(static_cast<long long>(chosen_lanes.of[chosen]));
  return _mm256_permutevar8x32_ps(a, _mm256_cvtepu8_epi32(lanes));
}
BOULE_INLINE void store_chosen(float* p, Floats a, unsigned chosen) {
  _mm256_storeu_ps(p, chosen_first(a, chosen));
}
BOULE_INLINE void store_chosen(double* p, Doubles a, unsigned chosen) {
  // As pairs of floats.
  constexpr unsigned pairs[16] = {0x00, 0x03, 0x0c, 0x0f, 0x30, 0x33, 0x3c, 0x3f,
                                  0xc0, 0xc3, 0xcc, 0xcf, 0xf0, 0xf3, 0xfc, 0xff};
  const __m128i lanes = _mm_cvtsi64_si128(static_cast<long long>(chosen_lanes.of[pairs[chosen]]));
  const __m256 together =
      _mm256_permutevar8x32_ps(_mm256_castpd_ps(a), _mm256_cvtepu8_epi32(lanes));
  _mm256_storeu_pd(p, _mm256_castps_pd(together));
}
#else
template <class T, class Lanes>
BOULE_INLINE void store_chosen_one_by_one(T* p, const Lanes& a, unsigned chosen) {
  alignas(16) T lanes[Lanes::size];
  a.store_aligned(lanes);
  for (const unsigned set : {chosen, ~chosen & ((1U << Lanes::size) - 1)}) {
    for (unsigned left = set; left != 0; left &= left - 1) *p++ = lanes[__builtin_ctz(left)];
  }
}
BOULE_INLINE void store_chosen(float* p, Floats a, unsigned chosen) {
  store_chosen_one_by_one(p, a, chosen);
}
BOULE_INLINE void store_chosen(double* p, Doubles a, unsigned chosen) {
  store_chosen_one_by_one(p, a, chosen);
}
#endif
BOULE_INLINE void store_chosen(float* p, Floats a, FloatMask chosen, Floats rest) {
  store_chosen(p, xsimd::select(chosen, a, rest), bits(chosen));
}
#endif

// The same, but of each the 16 bits behind the sign.
#if defined(__AVX512F__)
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen, Floats rest) {
  const __m512i whole = _mm512_castps_si512(_mm512_mask_compress_ps(rest, chosen, a));
  const __m512i half = _mm512_srli_epi32(whole, 15);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtusepi32_epi16(half));
}
#elif defined(__AVX2__)
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen, Floats rest) {
  const __m256i whole =
      _mm256_castps_si256(chosen_first(xsimd::select(chosen, a, rest), bits(chosen)));
  const __m256i half = _mm256_srli_epi32(whole, 15);
  const __m128i low = _mm256_castsi256_si128(half), high = _mm256_extracti128_si256(half, 1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_packus_epi32(low, high));
}
#else
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen, Floats rest) {
  alignas(16) float whole[Floats::size];
  store_chosen(whole, a, chosen, rest);
  for (std::size_t k = 0; k < Floats::size; ++k)
    p[k] = static_cast<std::uint16_t>(__builtin_bit_cast(std::uint32_t, whole[k]) << 1 >> 16);
}
#endif

// A place of the least of 16 numbers.
#if defined(__SSE4_2__)
BOULE_INLINE std::size_t place_of_least(const std::uint16_t* p) {
  const auto* const eights = reinterpret_cast<const __m128i*>(p);
  const __m128i less = _mm_min_epu16(_mm_load_si128(eights), _mm_load_si128(eights + 1));
  const auto found = static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(less)));
  const std::size_t place = found >> 16;
  return place + (p[place] == (found & 0xffff) ? 0 : 8);
}
#else
BOULE_INLINE std::size_t place_of_least(const std::uint16_t* p) {
  const std::uint16_t least = vminvq_u16(vminq_u16(vld1q_u16(p), vld1q_u16(p + 8)));
  std::size_t place = 0;
  while (p[place] != least) ++place;
  return place;
}
#endif

// Unsigned integers as doubles. Without an instruction: less 2^31, as signed ones, and that back.
#if defined(__SSE4_2__) && !defined(__AVX512F__)
BOULE_INLINE __m128i less_two_to_31(__m128i a) {
  return _mm_xor_si128(a, _mm_set1_epi32(-0x7fffffff - 1));
}
#endif
#if defined(__AVX512F__)
BOULE_INLINE Doubles to_double_low(Integers a) {
  return _mm512_cvtepu32_pd(_mm512_castsi512_si256(a));
}
BOULE_INLINE Doubles to_double_high(Integers a) {
  return _mm512_cvtepu32_pd(_mm512_extracti64x4_epi64(a, 1));
}
#elif defined(__AVX2__)
BOULE_INLINE Doubles to_double(__m128i a) {
  return _mm256_add_pd(_mm256_cvtepi32_pd(less_two_to_31(a)), _mm256_set1_pd(0x1p31));
}
BOULE_INLINE Doubles to_double_low(Integers a) { return to_double(_mm256_castsi256_si128(a)); }
BOULE_INLINE Doubles to_double_high(Integers a) {
  return to_double(_mm256_extracti128_si256(a, 1));
}
#elif defined(__SSE4_2__)
BOULE_INLINE Doubles to_double_low(Integers a) {
  return _mm_add_pd(_mm_cvtepi32_pd(less_two_to_31(a)), _mm_set1_pd(0x1p31));
}
BOULE_INLINE Doubles to_double_high(Integers a) {
  const __m128i high = _mm_unpackhi_epi64(a, a);
  return to_double_low(high);
}
#else
BOULE_INLINE Doubles to_double_low(Integers a) { return vcvtq_f64_u64(vmovl_u32(vget_low_u32(a))); }
BOULE_INLINE Doubles to_double_high(Integers a) { return vcvtq_f64_u64(vmovl_high_u32(a)); }
#endif

// As many signed integers as doubles; and the lanes whose byte is not 0.
#if defined(__AVX512F__)
BOULE_INLINE Doubles load_as_doubles(const std::int32_t* p) {
  return _mm512_cvtepi32_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  return static_cast<__mmask8>(_mm_test_epi8_mask(bytes, bytes));
}
#elif defined(__AVX2__)
BOULE_INLINE Doubles load_as_doubles(const std::int32_t* p) {
  return _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m256i bytes = _mm256_cvtepu8_epi64(_mm_loadu_si32(p));
  return _mm256_castsi256_pd(_mm256_cmpgt_epi64(bytes, _mm256_setzero_si256()));
}
#elif defined(__SSE4_2__)
BOULE_INLINE Doubles load_as_doubles(const std::int32_t* p) {
  return _mm_cvtepi32_pd(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
}
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m128i bytes = _mm_cvtepu8_epi64(_mm_loadu_si16(p));
  return _mm_castsi128_pd(_mm_cmpgt_epi64(bytes, _mm_setzero_si128()));
}
#else
BOULE_INLINE Doubles load_as_doubles(const std::int32_t* p) {
  return vcvtq_f64_s64(vmovl_s32(vld1_s32(p)));
}
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const uint64x2_t bytes = {p[0], p[1]};
  return vtstq_u64(bytes, bytes);
}
#endif

// Rows of four floats: lanes 4k .. 4k + 3 are the row at p[4k], any address, or at p + 16k.
#if defined(__AVX512F__)
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
BOULE_INLINE Floats load_fours(const float* const* p) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[0])), _mm_loadu_ps(p[4]), 1);
}
BOULE_INLINE void store_fours(float* p, Floats a) {
  _mm_store_ps(p, _mm256_castps256_ps128(a));
  _mm_store_ps(p + 16, _mm256_extractf128_ps(a, 1));
}
#else
BOULE_INLINE Floats load_fours(const float* const* p) { return Floats::load_unaligned(p[0]); }
BOULE_INLINE void store_fours(float* p, Floats a) { a.store_aligned(p); }
#endif

}  // namespace gaps

}  // namespace boule::BOULE_KERNEL_ISA
