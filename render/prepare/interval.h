#pragma once

#include <algorithm>

#include "core/math/random.h"

namespace boule {

/// A part of the numbers in [0, 1).
struct Interval {
  double first, size;
};

/// A random number of an interval, spread over [0, 1) again. So a number that has chosen one of
/// several intervals can be used once more. Precondition: the interval holds u, but for rounding.
inline double rescale(double u, const Interval& interval) {
  return std::clamp((u - interval.first) / interval.size, 0.0, below_one);
}

}  // namespace boule
