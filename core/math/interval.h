#pragma once

#include "core/math/number.h"
#include "core/math/random.h"

namespace boule {

/// A part of the numbers in [0, 1).
template <class T>
struct IntervalOf {
  T first, size;
};
using Interval = IntervalOf<double>;

/// A random number of an interval, spread over [0, 1) again. So a number that has chosen one of
/// several intervals can be used once more. Precondition: the interval holds u, up to rounding.
template <class T = double>
BOULE_INLINE T rescale(const T& u, const IntervalOf<T>& interval) {
  const T spread = (u - interval.first) / interval.size, most(below_one);
  return select(spread < T(0.0), T(0.0), select(most < spread, most, spread));
}

}  // namespace boule
