#pragma once

#include <cstdint>
#include <limits>

#include "core/math/ray.h"
#include "core/math/vec.h"

namespace boule {

/// The hit of one traced ray. The defaults are those of a miss.
struct TracedHit {
  double t =
      std::numeric_limits<double>::infinity();  ///< double, in units of the direction's length
  std::int32_t id =
      no_primitive;  ///< of the primitive: spheres in order, then planes, then capsules
  Vec3f normal{};    ///< geometric, unit length, against the ray; miss: 0
  /// The ray goes into the primitive there: into a sphere, which a tangent does, too, or through a
  /// plane against its normal.
  bool entering = false;
};

}  // namespace boule
