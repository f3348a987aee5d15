#pragma once

#include "core/math/elementary.h"
#include "core/math/number.h"

namespace boule {

/// A point of the unit disc.
template <class T>
struct DiscPointOf {
  T x, y;
};

/// The point of the unit disc for a lens sample, 0 .. 1 each: the squares around the sample
/// square's middle become the circles around the disc's, a quarter of the circle for each side
/// (Shirley and Chiu, "A low distortion map between disk and square", Journal of Graphics Tools
/// 2(3), 1997). Areas keep their proportions, and the middle, (0.5, 0.5), stays.
template <class T>
BOULE_INLINE DiscPointOf<T> disc_point(const T& lens_x, const T& lens_y) {
  const T x = lens_x * T(2.0) - T(1.0);
  const T y = lens_y * T(2.0) - T(1.0);
  const Mask<T> wide = abs(y) < abs(x);
  const T major = select(wide, x, y), minor = select(wide, y, x);
  const Mask<T> middle = major == T(0.0);
  const T ratio = minor / select(middle, T(1.0), major);
  const T angle = T(elementary::pi / 4) * ratio;
  const T near = major * elementary::cosine(angle * angle);
  const T across = major * (angle * elementary::sine_ratio(angle * angle));
  return {select(wide, near, across), select(wide, across, near)};
}

}  // namespace boule
