#pragma once

#include <cstddef>

#include "core/math/light_cone.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
#include "simd/abi/shading.h"
#include "simd/kernel/vectors.h"

/// Random numbers and directions by them, W at a time.
namespace boule::BOULE_KERNEL_ISA {

/// As that of core/math/random.h.
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

BOULE_INLINE void to_world(const LocalDirectionStream& directions) {
  for (std::size_t first = 0; first < directions.size; first += width) {
    const AngleOf<Wide> from{load(directions.cosine + first), load(directions.sine + first)};
    store(directions.direction, first,
          direction_about(load(directions.axis, first), from, load(directions.turns + first)));
  }
}

BOULE_INLINE void sample_cones(const LightConeStream& cones) {
  for (std::size_t first = 0; first < cones.size; first += width) {
    const LightConeOf<Wide> cone(load(cones.org, first), load(cones.center, first),
                                 load(cones.radius + first));
    const Vec3<Wide> direction = cone.direction({load(cones.u + first), load(cones.v + first)});
    store(cones.direction, first, direction);
    store(cones.density + first, cone.density());
    store(cones.tmax + first, narrow(cone.free_distance(direction)));
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
