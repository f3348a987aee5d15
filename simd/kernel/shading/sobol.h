#pragma once

#include <cstddef>

#include "simd/abi/shading.h"
#include "simd/lanes/lanes.h"

/// Points of Sobol's sequence, W at a time: core/math/sobol.h in lanes, bit for bit.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE Bits reverse_bits(Bits x) {
  x = (x << 16) | (x >> 16);
  x = ((x & Bits(0x00ff00ffU)) << 8) | ((x >> 8) & Bits(0x00ff00ffU));
  x = ((x & Bits(0x0f0f0f0fU)) << 4) | ((x >> 4) & Bits(0x0f0f0f0fU));
  x = ((x & Bits(0x33333333U)) << 2) | ((x >> 2) & Bits(0x33333333U));
  return ((x & Bits(0x55555555U)) << 1) | ((x >> 1) & Bits(0x55555555U));
}

BOULE_INLINE Bits scramble(Bits x, Bits seed) {
  x = x ^ x * Bits(0x3d20adeaU);
  x = x + seed;
  x = x * ((seed >> 16) | Bits(1));
  x = x ^ x * Bits(0x05526c56U);
  return x ^ x * Bits(0x53a22864U);
}

BOULE_INLINE Bits pascal(Bits x) {
  x = x ^ ((x >> 1) & Bits(0x55555555U));
  x = x ^ ((x >> 2) & Bits(0x33333333U));
  x = x ^ ((x >> 4) & Bits(0x0f0f0f0fU));
  x = x ^ ((x >> 8) & Bits(0x00ff00ffU));
  return x ^ (x >> 16);
}

BOULE_INLINE void sobol_points(const SobolStream& points) {
  for (std::size_t first = 0; first < points.size; first += width) {
    const Bits sample = load_integers(points.sample + first);
    const Bits index =
        reverse_bits(scramble(reverse_bits(sample), load_integers(points.shuffle + first)));
    const Bits u = scramble(index, load_integers(points.seed_u + first));
    const Bits v = scramble(pascal(index), load_integers(points.seed_v + first));
    store(points.u + first, to_wide(reverse_bits(u)) * Wide(0x1p-32));
    store(points.v + first, to_wide(reverse_bits(v)) * Wide(0x1p-32));
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
