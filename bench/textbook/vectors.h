#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// Vectors of floats and of doubles by the compiler's vector extension, one register each, so that
/// contenders share no code with Boule's kernels. For sources that are compiled once per ISA.
/// Multiplications and additions are fused where the ISA can.
namespace boule::bench::BOULE_KERNEL_ISA {

#if defined(__AVX512F__)
inline constexpr int vector_size = 64;  // bytes
#elif defined(__AVX2__)
inline constexpr int vector_size = 32;
#else
inline constexpr int vector_size = 16;
#endif

#ifdef BOULE_KERNEL_SCALAR
using Floats = float;
using Doubles = double;
template <class V>
inline constexpr int lanes_of = 1;

inline bool none(bool m) { return !m; }
template <class V>
V pick(bool m, V a, V b) {
  return m ? a : b;
}
inline float root(float x) { return __builtin_sqrtf(x); }
inline double root(double x) { return __builtin_sqrt(x); }
template <class V>
V get(const float* p) {
  return *p;
}
template <class V>
void put(float* p, V v) {
  *p = static_cast<float>(v);
}
template <class V>
V all(float x) {
  return x;
}
#else
typedef float Floats __attribute__((vector_size(vector_size)));
typedef double Doubles __attribute__((vector_size(vector_size)));
typedef float HalfFloats __attribute__((vector_size(vector_size / 2)));
// Compilers differ in the integers of a mask.
using FloatMask = decltype(Floats{} < Floats{});
using DoubleMask = decltype(Doubles{} < Doubles{});
template <class V>
inline constexpr int lanes_of = vector_size / static_cast<int>(sizeof(V{}[0]));

inline Floats pick(FloatMask m, Floats a, Floats b) { return m ? a : b; }
inline Doubles pick(DoubleMask m, Doubles a, Doubles b) { return m ? a : b; }

template <class V>
V get(const float* p) {
  if constexpr (sizeof(V{}[0]) == sizeof(float)) {
    return *reinterpret_cast<const V*>(p);
  } else {
    return __builtin_convertvector(*reinterpret_cast<const HalfFloats*>(p), V);
  }
}
template <class V>
void put(float* p, V v) {
  if constexpr (sizeof(V{}[0]) == sizeof(float)) {
    *reinterpret_cast<V*>(p) = v;
  } else {
    *reinterpret_cast<HalfFloats*>(p) = __builtin_convertvector(v, HalfFloats);
  }
}
template <class V>
V all(float x) {
  return x - V{};
}
#endif

#if defined(__AVX512F__)
inline bool none(FloatMask m) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(m)) == 0; }
inline bool none(DoubleMask m) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m)) == 0; }
inline Floats root(Floats x) { return _mm512_sqrt_ps(x); }
inline Doubles root(Doubles x) { return _mm512_sqrt_pd(x); }
#elif defined(__AVX2__)
inline bool none(FloatMask m) { return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) == 0; }
inline bool none(DoubleMask m) { return _mm256_movemask_pd(reinterpret_cast<__m256d>(m)) == 0; }
inline Floats root(Floats x) { return _mm256_sqrt_ps(x); }
inline Doubles root(Doubles x) { return _mm256_sqrt_pd(x); }
#elif defined(__SSE4_2__) && !defined(BOULE_KERNEL_SCALAR)
inline bool none(FloatMask m) { return _mm_movemask_ps(reinterpret_cast<__m128>(m)) == 0; }
inline bool none(DoubleMask m) { return _mm_movemask_pd(reinterpret_cast<__m128d>(m)) == 0; }
inline Floats root(Floats x) { return _mm_sqrt_ps(x); }
inline Doubles root(Doubles x) { return _mm_sqrt_pd(x); }
#elif !defined(BOULE_KERNEL_SCALAR)
template <class M>
bool none(M m) {
  bool some = false;
  for (int i = 0; i < lanes_of<M>; ++i) some = some || m[i] != 0;
  return !some;
}
template <class V>
V root(V x) {
  for (int i = 0; i < lanes_of<V>; ++i) x[i] = __builtin_sqrt(x[i]);
  return x;
}
#endif

/// a b + c and c - a b.
#if defined(__AVX512F__)
inline constexpr bool fuses = true;
inline Floats multiply_add(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
inline Doubles multiply_add(Doubles a, Doubles b, Doubles c) { return _mm512_fmadd_pd(a, b, c); }
#elif defined(__AVX2__)
inline constexpr bool fuses = true;
inline Floats multiply_add(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
inline Doubles multiply_add(Doubles a, Doubles b, Doubles c) { return _mm256_fmadd_pd(a, b, c); }
#else
inline constexpr bool fuses = false;
template <class V>
V multiply_add(V a, V b, V c) {
  return a * b + c;
}
#endif
template <class V>
V negated_multiply_add(V a, V b, V c) {
  return multiply_add(-a, b, c);
}

/// a < b ? a : b and a < b ? b : a.
template <class V>
V least(V a, V b) {
  return pick(a < b, a, b);
}
template <class V>
V most(V a, V b) {
  return pick(a < b, b, a);
}

/// The least and the greatest of the lanes, none of them NaN.
#ifdef BOULE_KERNEL_SCALAR
inline float least_lane(float x) { return x; }
inline float most_lane(float x) { return x; }
#else
template <std::size_t step, std::size_t... lane>
Floats lanes_apart(Floats x, std::index_sequence<lane...>) {
  return __builtin_shufflevector(x, x, (lane ^ step)...);
}
template <std::size_t step = lanes_of<Floats> / 2>
float least_lane(Floats x) {
  if constexpr (step == 0) {
    return x[0];
  } else {
    const auto lanes = std::make_index_sequence<lanes_of<Floats> >{};
    return least_lane<step / 2>(least(x, lanes_apart<step>(x, lanes)));
  }
}
template <std::size_t step = lanes_of<Floats> / 2>
float most_lane(Floats x) {
  if constexpr (step == 0) {
    return x[0];
  } else {
    const auto lanes = std::make_index_sequence<lanes_of<Floats> >{};
    return most_lane<step / 2>(most(x, lanes_apart<step>(x, lanes)));
  }
}
#endif

}  // namespace boule::bench::BOULE_KERNEL_ISA
