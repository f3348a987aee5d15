// The contender: the lecture's even-b quadratic in float, as fast as it goes in the loop shape of
// the kernels (W rays against one sphere, four spheres a branch, the root outside the hot loop).
// Compiled once per ISA; vectors by the compiler's own extension, so that it shares no code with
// what it is held against. Multiplications and additions are fused where the ISA can.
#include "bench/half_b.h"

#include <cstdint>
#include <limits>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace boule::bench::BOULE_KERNEL_ISA {
namespace {

#if defined(__AVX512F__)
constexpr int width = 16;
#elif defined(__AVX2__)
constexpr int width = 8;
#elif defined(BOULE_KERNEL_SCALAR)
constexpr int width = 1;
#else
constexpr int width = 4;
#endif

#ifdef BOULE_KERNEL_SCALAR
using Floats = float;
using Mask = bool;
bool none(Mask m) { return !m; }
float pick(Mask m, float a, float b) { return m ? a : b; }
float root(float x) { return __builtin_sqrtf(x); }
float multiply_add(float a, float b, float c) { return a * b + c; }
float negated_multiply_add(float a, float b, float c) { return c - a * b; }
Floats get(const float* p) { return *p; }
void put(float* p, Floats v) { *p = v; }
Floats all(float x) { return x; }
#else
typedef float Floats __attribute__((vector_size(width * 4)));
typedef std::int32_t Mask __attribute__((vector_size(width * 4)));

Floats get(const float* p) { return *reinterpret_cast<const Floats*>(p); }
void put(float* p, Floats v) { *reinterpret_cast<Floats*>(p) = v; }
Floats all(float x) { return x - Floats{}; }
Floats pick(Mask m, Floats a, Floats b) { return m ? a : b; }

#if defined(__AVX512F__)
bool none(Mask m) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(m)) == 0; }
Floats root(Floats x) { return _mm512_sqrt_ps(x); }
Floats multiply_add(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
Floats negated_multiply_add(Floats a, Floats b, Floats c) { return _mm512_fnmadd_ps(a, b, c); }
#elif defined(__AVX2__)
bool none(Mask m) { return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) == 0; }
Floats root(Floats x) { return _mm256_sqrt_ps(x); }
Floats multiply_add(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
Floats negated_multiply_add(Floats a, Floats b, Floats c) { return _mm256_fnmadd_ps(a, b, c); }
#elif defined(__SSE4_2__)
bool none(Mask m) { return _mm_movemask_ps(reinterpret_cast<__m128>(m)) == 0; }
Floats root(Floats x) { return _mm_sqrt_ps(x); }
Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
Floats negated_multiply_add(Floats a, Floats b, Floats c) { return c - a * b; }
#else
bool none(Mask m) { return (m[0] | m[1] | m[2] | m[3]) == 0; }
Floats root(Floats x) {
  for (int i = 0; i < width; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
}
Floats multiply_add(Floats a, Floats b, Floats c) { return a * b + c; }
Floats negated_multiply_add(Floats a, Floats b, Floats c) { return c - a * b; }
#endif
#endif

struct Packet {
  Floats ox, oy, oz, dx, dy, dz;
};

struct Quadratic {
  Floats b, discriminant;
};

/// f = c - o, b = f.d, discriminant = b^2 + (r^2 - f.f), for unit d.
[[gnu::always_inline]] inline Quadratic quadratic(const Packet& p, const HalfBData& s,
                                                  std::size_t i) {
  const Floats fx = all(s.center_x[i]) - p.ox, fy = all(s.center_y[i]) - p.oy;
  const Floats fz = all(s.center_z[i]) - p.oz;
  const Floats b = multiply_add(fz, p.dz, multiply_add(fy, p.dy, fx * p.dx));
  const Floats rest = negated_multiply_add(
      fz, fz, negated_multiply_add(fy, fy, negated_multiply_add(fx, fx, all(s.radius_squared[i]))));
  return {b, multiply_add(b, b, rest)};
}

[[gnu::always_inline]] inline Floats nearer(const Quadratic& q, Floats best) {
  const Floats half_chord = root(q.discriminant);
  const Floats first = q.b - half_chord, second = q.b + half_chord;
  const Floats zero = all(0.0F);
  const Floats t = pick(first > zero, first, second);
  const Mask hit = (q.discriminant >= zero) & (t > zero) & (t < best);
  return pick(hit, t, best);
}

}  // namespace

void half_b(const HalfBData& data) {
  constexpr std::size_t chunk = 256;
  std::uint32_t list[chunk + 4];
  const Floats zero = all(0.0F);
  for (std::size_t ray = 0; ray < data.rays; ray += width) {
    const Packet p = {get(data.org_x + ray), get(data.org_y + ray), get(data.org_z + ray),
                      get(data.dir_x + ray), get(data.dir_y + ray), get(data.dir_z + ray)};
    Floats best = all(std::numeric_limits<float>::infinity());
    for (std::size_t begin = 0; begin < data.spheres; begin += chunk) {
      const std::size_t end = begin + chunk < data.spheres ? begin + chunk : data.spheres;
      std::size_t count = 0;
      for (std::size_t i = begin; i < end; i += 4) {  // padded: four may be read
        const Mask m0 = quadratic(p, data, i).discriminant >= zero;
        const Mask m1 = quadratic(p, data, i + 1).discriminant >= zero;
        const Mask m2 = quadratic(p, data, i + 2).discriminant >= zero;
        const Mask m3 = quadratic(p, data, i + 3).discriminant >= zero;
        if (none(m0 | m1 | m2 | m3)) continue;
        list[count] = static_cast<std::uint32_t>(i);
        count += none(m0) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 1);
        count += none(m1) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 2);
        count += none(m2) ? 0 : 1;
        list[count] = static_cast<std::uint32_t>(i + 3);
        count += none(m3) ? 0 : 1;
      }
      for (std::size_t k = 0; k < count; ++k) best = nearer(quadratic(p, data, list[k]), best);
    }
    put(data.t + ray, best);
  }
}

}  // namespace boule::bench::BOULE_KERNEL_ISA
