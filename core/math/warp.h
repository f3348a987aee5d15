#pragma once

#include "core/math/elementary.h"
#include "core/math/number.h"
#include "core/math/vec.h"

namespace boule {

/// Maps from the unit square to directions, with the same bits on every machine. Directions are of
/// unit length; densities are per solid angle. Preconditions, unchecked in these inner loops: axes
/// of unit length, u in [0, 1), turns in [0, 1], 0 < height <= 2, n >= 0. T is double, or lanes of
/// it.

/// Cosine and sine of an angle: around an axis, or from it.
template <class T>
struct AngleOf {
  T cosine, sine;
};
using Angle = AngleOf<double>;

/// The angle of `turns` full turns, 0 <= turns <= 1; error below 1e-15.
template <class T>
BOULE_INLINE AngleOf<T> full_turns(const T& turns) {
  const T quarters = turns * T(4.0) + T(0.5);
  T quarter(0.0);  // quarters, rounded down
  for (double k = 1; k <= 4; ++k) quarter = select(T(k) <= quarters, T(k), quarter);
  const T a = (turns - quarter * T(0.25)) * T(2 * elementary::pi), z = a * a;  // |a| <= pi / 4
  constexpr double sines[] = {-1.0 / 6,        1.0 / 120,         -1.0 / 5040,         1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800., -1.0 / 1307674368000};
  constexpr double cosines[] = {
      -1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
      -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  T s(0.0), c(0.0);  // Taylor: sin = a + a z s, cos = 1 + z c
  for (int k = 6; k >= 0; --k) s = T(sines[k]) + z * s;
  for (int k = 7; k >= 0; --k) c = T(cosines[k]) + z * c;
  const T sine = a + a * (z * s), cosine = T(1.0) + z * c;
  const Mask<T> odd = (quarter == T(1.0)) | (quarter == T(3.0));
  const T sign = select((quarter == T(2.0)) | (quarter == T(3.0)), T(-1.0), T(1.0));
  return {select(odd, sine * T(-1.0), cosine) * sign, select(odd, cosine, sine) * sign};
}

/// The direction at an angle `from` the axis and `turns` around it. Two axes across it by Duff et
/// al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
template <class T>
BOULE_INLINE Vec3<T> direction_about(const Vec3<T>& axis, const AngleOf<T>& from, const T& turns) {
  const T sign = copysign(T(1.0), axis.z), minus = sign * T(-1.0);
  const T a = T(-1.0) / (sign + axis.z), b = axis.x * axis.y * a;
  const Vec3<T> x{T(1.0) + sign * axis.x * axis.x * a, sign * b, minus * axis.x};
  const Vec3<T> y{b, sign + axis.y * axis.y * a, axis.y * T(-1.0)};
  const AngleOf<T> around = full_turns(turns);
  return x * (from.sine * around.cosine) + y * (from.sine * around.sine) + axis * from.cosine;
}

/// The angle from the axis of a direction with Lambert's density, cosine / pi; 0 <= u < 1.
template <class T = double>
BOULE_INLINE AngleOf<T> warp_to_cosine(const T& u) {
  return {sqrt(T(1.0) - u), sqrt(u)};
}
template <class T = double>
BOULE_INLINE T cosine_density(const T& cosine) {
  return cosine * T(1 / elementary::pi);
}

/// The same with the density (n + 1) / (2 pi) cosine^n, a lobe of Phong's (Lafortune and Willems,
/// "Using the modified Phong reflectance model for physically based rendering", 1994). Its power
/// has the accuracy of a float: the direction becomes one.
template <class T = double>
BOULE_INLINE AngleOf<T> warp_to_power(const T& u, const T& n) {
  const T cosine = elementary::pow_for_float(T(1.0) - u, T(1.0) / (n + T(1.0)));
  return {cosine, sqrt(positive(T(1.0) - cosine * cosine))};
}
template <class T = double>
BOULE_INLINE T power_density(const T& power, const T& n) {  // power: cosine^n
  return (n + T(1.0)) * power * T(1 / (2 * elementary::pi));
}

/// The same, spread evenly over a cone whose half angle has the cosine 1 - height.
template <class T>
BOULE_INLINE AngleOf<T> warp_to_cone(const T& u, const T& height) {
  const T h = u * height;
  return {T(1.0) - h, sqrt(h * (T(2.0) - h))};
}
template <class T>
BOULE_INLINE T cone_density(const T& height) {
  return T(1.0) / (T(2 * elementary::pi) * height);
}

}  // namespace boule
