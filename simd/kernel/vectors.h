#pragma once

#include <cstddef>

#include "core/math/vec.h"
#include "simd/abi/shading.h"
#include "simd/lanes/lanes.h"

/// Vectors of doubles in lanes.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE void store(const VectorStream& vectors, std::size_t first, const Vec3<Wide>& v) {
  store(vectors.x + first, v.x);
  store(vectors.y + first, v.y);
  store(vectors.z + first, v.z);
}
BOULE_INLINE Vec3<Wide> load(const VectorStream& vectors, std::size_t first) {
  return {load(vectors.x + first), load(vectors.y + first), load(vectors.z + first)};
}
BOULE_INLINE void store_chosen(const VectorStream& vectors, std::size_t first, const Vec3<Wide>& v,
                               unsigned chosen) {
  store_chosen(vectors.x + first, v.x, chosen);
  store_chosen(vectors.y + first, v.y, chosen);
  store_chosen(vectors.z + first, v.z, chosen);
}

}  // namespace boule::BOULE_KERNEL_ISA
