#pragma once

#include "core/base/platform.h"

#if defined(__AVX2__)

#include <immintrin.h>

/// The few wide operations that Embree's callbacks need, by intrinsics; masks in mask registers
/// where there are any. Compiled once per ISA, like the kernels; nothing below AVX2.
namespace boule::bench::BOULE_KERNEL_ISA {

#if defined(__AVX512VL__)

struct Lanes4 {
  using Real = __m128;
  using Mask = __mmask8;
  static constexpr unsigned width = 4;
  BOULE_INLINE static Real all(float x) { return _mm_set1_ps(x); }
  BOULE_INLINE static Real load(const float* p) { return _mm_loadu_ps(p); }
  BOULE_INLINE static Mask valid(const int* p) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
    return _mm_test_epi32_mask(v, v);
  }
  BOULE_INLINE static Real fma(Real a, Real b, Real c) { return _mm_fmadd_ps(a, b, c); }
  BOULE_INLINE static Real fnma(Real a, Real b, Real c) { return _mm_fnmadd_ps(a, b, c); }
  BOULE_INLINE static Real root(Real a) { return _mm_sqrt_ps(a); }
  BOULE_INLINE static Mask less(Real a, Real b) { return _mm_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  BOULE_INLINE static Mask at_most(Real a, Real b) { return _mm_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  BOULE_INLINE static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  BOULE_INLINE static Mask either(Mask a, Mask b) { return static_cast<Mask>(a | b); }
  BOULE_INLINE static bool none(Mask m) { return m == 0; }
  BOULE_INLINE static Real pick(Mask m, Real a, Real b) { return _mm_mask_blend_ps(m, b, a); }
  BOULE_INLINE static void store(float* p, Mask m, Real a) { _mm_mask_storeu_ps(p, m, a); }
  BOULE_INLINE static void store_word(float* p, Mask m, unsigned word) {
    _mm_mask_storeu_epi32(p, m, _mm_set1_epi32(static_cast<int>(word)));
  }
};

struct Lanes8 {
  using Real = __m256;
  using Mask = __mmask8;
  static constexpr unsigned width = 8;
  BOULE_INLINE static Real all(float x) { return _mm256_set1_ps(x); }
  BOULE_INLINE static Real load(const float* p) { return _mm256_loadu_ps(p); }
  BOULE_INLINE static Mask valid(const int* p) {
    const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    return _mm256_test_epi32_mask(v, v);
  }
  BOULE_INLINE static Real fma(Real a, Real b, Real c) { return _mm256_fmadd_ps(a, b, c); }
  BOULE_INLINE static Real fnma(Real a, Real b, Real c) { return _mm256_fnmadd_ps(a, b, c); }
  BOULE_INLINE static Real root(Real a) { return _mm256_sqrt_ps(a); }
  BOULE_INLINE static Mask less(Real a, Real b) { return _mm256_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  BOULE_INLINE static Mask at_most(Real a, Real b) { return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  BOULE_INLINE static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  BOULE_INLINE static Mask either(Mask a, Mask b) { return static_cast<Mask>(a | b); }
  BOULE_INLINE static bool none(Mask m) { return m == 0; }
  BOULE_INLINE static Real pick(Mask m, Real a, Real b) { return _mm256_mask_blend_ps(m, b, a); }
  BOULE_INLINE static void store(float* p, Mask m, Real a) { _mm256_mask_storeu_ps(p, m, a); }
  BOULE_INLINE static void store_word(float* p, Mask m, unsigned word) {
    _mm256_mask_storeu_epi32(p, m, _mm256_set1_epi32(static_cast<int>(word)));
  }
};

struct Lanes16 {
  using Real = __m512;
  using Mask = __mmask16;
  static constexpr unsigned width = 16;
  BOULE_INLINE static Real all(float x) { return _mm512_set1_ps(x); }
  BOULE_INLINE static Real load(const float* p) { return _mm512_loadu_ps(p); }
  BOULE_INLINE static Mask valid(const int* p) {
    const __m512i v = _mm512_loadu_si512(p);
    return _mm512_test_epi32_mask(v, v);
  }
  BOULE_INLINE static Real fma(Real a, Real b, Real c) { return _mm512_fmadd_ps(a, b, c); }
  BOULE_INLINE static Real fnma(Real a, Real b, Real c) { return _mm512_fnmadd_ps(a, b, c); }
  BOULE_INLINE static Real root(Real a) { return _mm512_sqrt_ps(a); }
  BOULE_INLINE static Mask less(Real a, Real b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  BOULE_INLINE static Mask at_most(Real a, Real b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  BOULE_INLINE static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  BOULE_INLINE static Mask either(Mask a, Mask b) { return static_cast<Mask>(a | b); }
  BOULE_INLINE static bool none(Mask m) { return m == 0; }
  BOULE_INLINE static Real pick(Mask m, Real a, Real b) { return _mm512_mask_blend_ps(m, b, a); }
  BOULE_INLINE static void store(float* p, Mask m, Real a) { _mm512_mask_storeu_ps(p, m, a); }
  BOULE_INLINE static void store_word(float* p, Mask m, unsigned word) {
    _mm512_mask_storeu_epi32(p, m, _mm512_set1_epi32(static_cast<int>(word)));
  }
};

using Widest = Lanes16;

#else

struct Lanes4 {
  using Real = __m128;
  using Mask = __m128;
  static constexpr unsigned width = 4;
  BOULE_INLINE static Real all(float x) { return _mm_set1_ps(x); }
  BOULE_INLINE static Real load(const float* p) { return _mm_loadu_ps(p); }
  BOULE_INLINE static Mask valid(const int* p) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(p));  // 0 or all bits
  }
  BOULE_INLINE static Real fma(Real a, Real b, Real c) { return _mm_fmadd_ps(a, b, c); }
  BOULE_INLINE static Real fnma(Real a, Real b, Real c) { return _mm_fnmadd_ps(a, b, c); }
  BOULE_INLINE static Real root(Real a) { return _mm_sqrt_ps(a); }
  BOULE_INLINE static Mask less(Real a, Real b) { return _mm_cmp_ps(a, b, _CMP_LT_OQ); }
  BOULE_INLINE static Mask at_most(Real a, Real b) { return _mm_cmp_ps(a, b, _CMP_LE_OQ); }
  BOULE_INLINE static Mask both(Mask a, Mask b) { return _mm_and_ps(a, b); }
  BOULE_INLINE static Mask either(Mask a, Mask b) { return _mm_or_ps(a, b); }
  BOULE_INLINE static bool none(Mask m) { return _mm_movemask_ps(m) == 0; }
  BOULE_INLINE static Real pick(Mask m, Real a, Real b) { return _mm_blendv_ps(b, a, m); }
  BOULE_INLINE static void store(float* p, Mask m, Real a) {
    _mm_maskstore_ps(p, _mm_castps_si128(m), a);
  }
  BOULE_INLINE static void store_word(float* p, Mask m, unsigned word) {
    store(p, m, _mm_castsi128_ps(_mm_set1_epi32(static_cast<int>(word))));
  }
};

struct Lanes8 {
  using Real = __m256;
  using Mask = __m256;
  static constexpr unsigned width = 8;
  BOULE_INLINE static Real all(float x) { return _mm256_set1_ps(x); }
  BOULE_INLINE static Real load(const float* p) { return _mm256_loadu_ps(p); }
  BOULE_INLINE static Mask valid(const int* p) {
    return _mm256_loadu_ps(reinterpret_cast<const float*>(p));  // 0 or all bits
  }
  BOULE_INLINE static Real fma(Real a, Real b, Real c) { return _mm256_fmadd_ps(a, b, c); }
  BOULE_INLINE static Real fnma(Real a, Real b, Real c) { return _mm256_fnmadd_ps(a, b, c); }
  BOULE_INLINE static Real root(Real a) { return _mm256_sqrt_ps(a); }
  BOULE_INLINE static Mask less(Real a, Real b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  BOULE_INLINE static Mask at_most(Real a, Real b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  BOULE_INLINE static Mask both(Mask a, Mask b) { return _mm256_and_ps(a, b); }
  BOULE_INLINE static Mask either(Mask a, Mask b) { return _mm256_or_ps(a, b); }
  BOULE_INLINE static bool none(Mask m) { return _mm256_movemask_ps(m) == 0; }
  BOULE_INLINE static Real pick(Mask m, Real a, Real b) { return _mm256_blendv_ps(b, a, m); }
  BOULE_INLINE static void store(float* p, Mask m, Real a) {
    _mm256_maskstore_ps(p, _mm256_castps_si256(m), a);
  }
  BOULE_INLINE static void store_word(float* p, Mask m, unsigned word) {
    store(p, m, _mm256_castsi256_ps(_mm256_set1_epi32(static_cast<int>(word))));
  }
};

using Widest = Lanes8;

#endif

}  // namespace boule::bench::BOULE_KERNEL_ISA

#endif
