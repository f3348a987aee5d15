#pragma once

#include <cmath>

#include "core/scene/primitive.h"
#include "simd/abi/filter_bounds.h"

namespace boule {

/// Whether float filters, rejects and boxes, can judge a sphere: else it goes to the exact solver.
inline bool in_filter_range(const Sphere& s) {
  for (const float x : {s.center.x, s.center.y, s.center.z, s.radius}) {
    if (!(std::fabs(x) < filter::limit)) return false;  // NaN as well
  }
  return true;
}

}  // namespace boule
