#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/lanes/xsimd_types.h"

/// Operations on 32-bit integers in lanes that xsimd 8.1 lacks or has only slow code for:
/// comparisons and selections by the masks of floats, counting, conversion to doubles; and bytes as
/// masks.
namespace boule::BOULE_KERNEL_ISA::gaps {

// Lanes in which a == b, and in which a <= b, unsigned; and a where the mask is set, otherwise b.
#if defined(__AVX512F__)
BOULE_INLINE FloatMask equal(Integers a, Integers b) { return _mm512_cmpeq_epi32_mask(a, b); }
BOULE_INLINE FloatMask at_most(Integers a, Integers b) { return _mm512_cmple_epu32_mask(a, b); }
BOULE_INLINE Integers select(FloatMask m, Integers a, Integers b) {
  return _mm512_mask_blend_epi32(m, b, a);
}
#elif defined(__AVX2__)
BOULE_INLINE FloatMask equal(Integers a, Integers b) {
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
}
BOULE_INLINE FloatMask at_most(Integers a, Integers b) {
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_min_epu32(a, b), a));
}
BOULE_INLINE Integers select(FloatMask m, Integers a, Integers b) {
  return _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(b), _mm256_castsi256_ps(a), m));
}
#elif defined(__SSE4_2__)
BOULE_INLINE FloatMask equal(Integers a, Integers b) {
  return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b));
}
BOULE_INLINE FloatMask at_most(Integers a, Integers b) {
  return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_min_epu32(a, b), a));
}
BOULE_INLINE Integers select(FloatMask m, Integers a, Integers b) {
  return _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(b), _mm_castsi128_ps(a), m));
}
#else
BOULE_INLINE FloatMask equal(Integers a, Integers b) { return vceqq_u32(a, b); }
BOULE_INLINE FloatMask at_most(Integers a, Integers b) { return vcleq_u32(a, b); }
BOULE_INLINE Integers select(FloatMask m, Integers a, Integers b) { return vbslq_u32(m, a, b); }
#endif

// 0, 1, 2, ...
#if defined(__AVX512F__)
BOULE_INLINE Integers counted() {
  return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
#elif defined(__AVX2__)
BOULE_INLINE Integers counted() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
#elif defined(__SSE4_2__)
BOULE_INLINE Integers counted() { return _mm_setr_epi32(0, 1, 2, 3); }
#else
BOULE_INLINE Integers counted() {
  constexpr std::uint32_t steps[4] = {0, 1, 2, 3};
  return vld1q_u32(steps);
}
#endif

// Unsigned integers as doubles, the lower and the upper half of the lanes. Before AVX-512 there is
// an instruction for signed integers only: 2^31 is subtracted before it and added after it.
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

// Floats as integers with a sign, towards zero.
#if defined(__AVX512F__)
BOULE_INLINE Integers to_integers(Floats a) { return _mm512_cvttps_epi32(a); }
#elif defined(__AVX2__)
BOULE_INLINE Integers to_integers(Floats a) { return _mm256_cvttps_epi32(a); }
#elif defined(__SSE4_2__)
BOULE_INLINE Integers to_integers(Floats a) { return _mm_cvttps_epi32(a); }
#else
BOULE_INLINE Integers to_integers(Floats a) { return vreinterpretq_u32_s32(vcvtq_s32_f32(a)); }
#endif

// The lanes, of half a register, whose byte is not 0.
#if defined(__AVX512F__)
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  return static_cast<__mmask8>(_mm_test_epi8_mask(bytes, bytes));
}
#elif defined(__AVX2__)
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m256i bytes = _mm256_cvtepu8_epi64(_mm_loadu_si32(p));
  return _mm256_castsi256_pd(_mm256_cmpgt_epi64(bytes, _mm256_setzero_si256()));
}
#elif defined(__SSE4_2__)
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const __m128i bytes = _mm_cvtepu8_epi64(_mm_loadu_si16(p));
  return _mm_castsi128_pd(_mm_cmpgt_epi64(bytes, _mm_setzero_si128()));
}
#else
BOULE_INLINE DoubleMask load_set(const std::uint8_t* p) {
  const uint64x2_t bytes = {p[0], p[1]};
  return vtstq_u64(bytes, bytes);
}
#endif

// The bits of each integer in reverse order. x86-64 looks them up by four.
#if defined(__AVX512F__)
BOULE_INLINE Integers reverse_bits(Integers a) {
  const __m512i four = _mm512_set1_epi8(0x0f);
  const __m512i swapped = _mm512_shuffle_epi8(
      a, _mm512_broadcast_i32x4(_mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203)));
  const __m512i table =
      _mm512_broadcast_i32x4(_mm_set_epi64x(0x0f070b030d050901, 0x0e060a020c040800));
  const __m512i low = _mm512_shuffle_epi8(table, _mm512_and_si512(swapped, four));
  const __m512i high =
      _mm512_shuffle_epi8(table, _mm512_and_si512(_mm512_srli_epi32(swapped, 4), four));
  return _mm512_or_si512(_mm512_slli_epi32(low, 4), high);
}
#elif defined(__AVX2__)
BOULE_INLINE Integers reverse_bits(Integers a) {
  const __m256i four = _mm256_set1_epi8(0x0f);
  const __m256i swapped = _mm256_shuffle_epi8(
      a, _mm256_broadcastsi128_si256(_mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203)));
  const __m256i table =
      _mm256_broadcastsi128_si256(_mm_set_epi64x(0x0f070b030d050901, 0x0e060a020c040800));
  const __m256i low = _mm256_shuffle_epi8(table, _mm256_and_si256(swapped, four));
  const __m256i high =
      _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi32(swapped, 4), four));
  return _mm256_or_si256(_mm256_slli_epi32(low, 4), high);
}
#elif defined(__SSE4_2__)
BOULE_INLINE Integers reverse_bits(Integers a) {
  const __m128i four = _mm_set1_epi8(0x0f);
  const __m128i swapped =
      _mm_shuffle_epi8(a, _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203));
  const __m128i table = _mm_set_epi64x(0x0f070b030d050901, 0x0e060a020c040800);
  const __m128i low = _mm_shuffle_epi8(table, _mm_and_si128(swapped, four));
  const __m128i high = _mm_shuffle_epi8(table, _mm_and_si128(_mm_srli_epi32(swapped, 4), four));
  return _mm_or_si128(_mm_slli_epi32(low, 4), high);
}
#else
BOULE_INLINE Integers reverse_bits(Integers a) {
  return vreinterpretq_u32_u8(vrbitq_u8(vrev32q_u8(vreinterpretq_u8_u32(a))));
}
#endif

}  // namespace boule::BOULE_KERNEL_ISA::gaps
