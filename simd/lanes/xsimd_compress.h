#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/lanes/xsimd_gaps.h"
#include "simd/lanes/xsimd_integers.h"
#include "simd/lanes/xsimd_types.h"

/// Packing of chosen lanes, and the smallest of sixteen short numbers: the operations of queues and
/// lists of candidates. xsimd 8.1 has neither.
namespace boule::BOULE_KERNEL_ISA::gaps {

// store_chosen() packs the lanes of `chosen` at any address, and writes as many numbers as there
// are lanes: those after the chosen ones are undefined.
#if defined(__AVX512F__)
BOULE_INLINE void store_chosen(float* p, Floats a, unsigned chosen) {
  _mm512_storeu_ps(p, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a));
}
BOULE_INLINE void store_chosen(std::uint32_t* p, Integers a, unsigned chosen) {
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), a));
}
BOULE_INLINE void store_chosen(double* p, Doubles a, unsigned chosen) {
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(static_cast<__mmask8>(chosen), a));
}
#elif defined(__AVX2__)
/// For every set among eight lanes, a byte for each lane: first the numbers of the lanes in the
/// set, then those of the others.
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
BOULE_INLINE __m256i lanes_chosen_first(unsigned chosen) {
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(chosen_lanes.of[chosen])));
}
BOULE_INLINE void store_chosen(float* p, Floats a, unsigned chosen) {
  _mm256_storeu_ps(p, _mm256_permutevar8x32_ps(a, lanes_chosen_first(chosen)));
}
BOULE_INLINE void store_chosen(std::uint32_t* p, Integers a, unsigned chosen) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p),
                      _mm256_permutevar8x32_epi32(a, lanes_chosen_first(chosen)));
}
BOULE_INLINE void store_chosen(double* p, Doubles a, unsigned chosen) {
  // As pairs of floats.
  constexpr unsigned pairs[16] = {0x00, 0x03, 0x0c, 0x0f, 0x30, 0x33, 0x3c, 0x3f,
                                  0xc0, 0xc3, 0xcc, 0xcf, 0xf0, 0xf3, 0xfc, 0xff};
  const __m256 together =
      _mm256_permutevar8x32_ps(_mm256_castpd_ps(a), lanes_chosen_first(pairs[chosen]));
  _mm256_storeu_pd(p, _mm256_castps_pd(together));
}
#else
template <class T, class Lanes>
BOULE_INLINE void store_chosen(T* p, const Lanes& a, unsigned chosen) {
  alignas(16) T lanes[Lanes::size];
  a.store_aligned(lanes);
  for (const unsigned set : {chosen, ~chosen & ((1U << Lanes::size) - 1)}) {
    for (unsigned left = set; left != 0; left &= left - 1) *p++ = lanes[__builtin_ctz(left)];
  }
}
#endif

// Of numbers that are at least 0, the 16 bits behind the sign: eight of exponent and eight of
// mantissa, in the order of the numbers. Those of `chosen` packed, then 0xffff.
#if defined(__AVX512F__)
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen) {
  // As floats: GCC 12 would move them to integers through memory.
  const __m512 rest = _mm512_castsi512_ps(_mm512_set1_epi32(-1));
  const __m512i whole = _mm512_castps_si512(_mm512_mask_compress_ps(rest, chosen, a));
  const __m512i half = _mm512_srli_epi32(whole, 15);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtusepi32_epi16(half));
}
#elif defined(__AVX2__)
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen) {
  const __m256 rest = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
  const auto set = static_cast<unsigned>(_mm256_movemask_ps(chosen));
  const __m256i whole = _mm256_castps_si256(
      _mm256_permutevar8x32_ps(_mm256_blendv_ps(rest, a, chosen), lanes_chosen_first(set)));
  const __m256i half = _mm256_srli_epi32(whole, 15);
  const __m128i low = _mm256_castsi256_si128(half), high = _mm256_extracti128_si256(half, 1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_packus_epi32(low, high));
}
#else
BOULE_INLINE void store_chosen_halves(std::uint16_t* p, Floats a, FloatMask chosen) {
  alignas(16) std::uint32_t whole[Floats::size];
  const Integers number = std::bit_cast<Integers>(a);
  store_chosen(whole, select(chosen, number, Integers(0xffffffffU)), bits(chosen));
  for (std::size_t k = 0; k < Floats::size; ++k)
    p[k] = static_cast<std::uint16_t>(whole[k] << 1 >> 16);
}
#endif

// The index of the smallest of 16 numbers; of equal ones any.
#if defined(__SSE4_2__)
BOULE_INLINE std::size_t index_of_least(const std::uint16_t* p) {
  const auto* const eights = reinterpret_cast<const __m128i*>(p);
  const __m128i less = _mm_min_epu16(_mm_load_si128(eights), _mm_load_si128(eights + 1));
  const auto found = static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(less)));
  const std::size_t index = found >> 16;
  return index + (p[index] == (found & 0xffff) ? 0 : 8);
}
#else
BOULE_INLINE std::size_t index_of_least(const std::uint16_t* p) {
  const std::uint16_t least = vminvq_u16(vminq_u16(vld1q_u16(p), vld1q_u16(p + 8)));
  std::size_t index = 0;
  while (p[index] != least) ++index;
  return index;
}
#endif

}  // namespace boule::BOULE_KERNEL_ISA::gaps
