#pragma once

#include <cstdint>
#include <limits>

#include "core/math/ray.h"
#include "core/math/vec.h"

namespace boule {

/// What one traced ray meets. As it stands here: a miss.
struct TracedHit {
  double t = std::numeric_limits<double>::infinity();  ///< unrounded, in lengths of the direction
  std::int32_t id = no_primitive;  ///< the primitive's: spheres in order, then planes
  Vec3f normal;                    ///< geometric, unit length, turned against the ray; miss: 0
};

}  // namespace boule
