#pragma once

#include <cmath>

#include "core/math/number.h"
#include "core/math/vec.h"

namespace boule {

/// Euclidean length, in double; of one vector, or of W at a time.
template <class T = double>
BOULE_INLINE T length(const Vec3<T>& v) {
  return sqrt(dot(v, v));
}

/// v / |v|; NaN or 0 in some component if |v|^2 is 0, NaN or infinite.
template <class T = double>
BOULE_INLINE Vec3<T> normalize(const Vec3<T>& v) {
  return v * (T(1.0) / length(v));
}

/// True if every component is finite.
template <class T>
inline bool is_finite(const Vec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace boule
