#pragma once

#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::bench {

/// t of each ray with one capsule, in units of its direction, by Embree's round linear curves,
/// which compute in float; infinity: a miss; NaN: a ray that Embree calls invalid, as a coordinate
/// is beyond 1.8e18. Origins must be floats; tmin counts as 0, tmax as infinity. Empty where this
/// build has no Embree.
std::vector<double> embree_curve_hits(const Capsule& capsule, const std::vector<Ray>& rays);

}  // namespace boule::bench
