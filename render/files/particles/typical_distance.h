#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/math/vec.h"

namespace boule {

/// The median of the distances of some of the points to their nearest neighbours: about a thousand
/// points, from up to 16 regions with the same number of points each. Points at the same place are
/// no neighbours. 0 where no two points differ. Finite coordinates; the same for any threads.
double typical_distance(const std::vector<Vec3d>& points, const ParallelFor& parallel_for);

}  // namespace boule
