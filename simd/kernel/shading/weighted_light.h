#pragma once

#include <cstddef>

#include "simd/abi/paths.h"
#include "simd/kernel/shading/going_on.h"
#include "simd/kernel/vectors.h"

/// The light that rays add to samples, W rays at a time.
namespace boule::BOULE_KERNEL_ISA {

/// Several rays can belong to one sample, so the sums are formed one after the other, four numbers
/// at a time.
BOULE_INLINE void add_weighted_light(const WeightedLight& light, ColorSum* sums) {
  alignas(64) float rows[4 * width];
  for (std::size_t first = 0; first < light.size; first += width) {
    const Vec3<Real> sent =
        light_product(load(light.throughput, first), load(light.radiance, first));
    store_rows(rows, {sent.x, sent.y, sent.z, Real(0.0F)});
    const std::size_t left = light.size - first, live = left < width ? left : width;
    for (std::size_t lane = 0; lane < live; ++lane) {
      float* const sum = sums[light.sample[first + lane]].rgb0;
      for (std::size_t c = 0; c < 4; ++c) sum[c] += rows[4 * lane + c];
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
