#pragma once

#include <cstddef>

#include "core/math/sobol.h"
#include "simd/abi/shading.h"
#include "simd/lanes/lanes.h"

/// Random numbers, W pairs at a time.
namespace boule::BOULE_KERNEL_ISA {

/// As unit_interval() of core/math/random.h.
BOULE_INLINE Wide unit_interval(Bits x) { return to_wide(x) * Wide(0x1p-32); }

BOULE_INLINE void sobol_points(const SobolStream& points) {
  for (std::size_t first = 0; first < points.size; first += width) {
    const SobolSeedsOf<Bits> seeds{load_integers(points.shuffle + first),
                                   load_integers(points.seed_u + first),
                                   load_integers(points.seed_v + first)};
    const UnitPairOf<Wide> point = sobol_point(seeds, load_integers(points.sample + first));
    store(points.u + first, point.u);
    store(points.v + first, point.v);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
