#pragma once

#include <cstdint>
#include <vector>

namespace boule {

/// Primitives of points, point after point: those of point k are at offset[k] .. offset[k + 1] - 1,
/// in the order of ids.
struct Members {
  std::vector<std::int64_t> offset;  ///< one more than there are points
  std::vector<std::int32_t> id;
};

/// Pairs of spheres, in the order of `first`, then of `second`.
struct SpherePairs {
  std::vector<std::int32_t> first, second;  ///< ids: first < second
  std::vector<double> gap;                  ///< the distance of their surfaces; negative: overlap
};

/// The output columns for nearest primitives: k numbers of each point.
struct NearestColumns {
  double* distance = nullptr;
  std::int32_t* id = nullptr;
};

}  // namespace boule
