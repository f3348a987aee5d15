#pragma once

#include <cmath>

#include "core/math/vec.h"

namespace boule {

/// Euclidean length, in double.
inline double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }

/// v / |v|; NaN or 0 in some component where |v|^2 is 0, NaN or infinite.
inline Vec3d normalize(const Vec3d& v) { return v * (1.0 / length(v)); }

/// True if no component is NaN or infinite.
template <class T>
inline bool is_finite(const Vec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace boule
