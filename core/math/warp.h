#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/vec.h"

namespace boule {

/// From the unit square to directions, the same bits on every machine. Directions are of unit
/// length; densities are per solid angle. Preconditions, which nobody checks in these inner loops:
/// axes of unit length, u in [0, 1), turns in [0, 1], 0 < height <= 2, n >= 0.

/// Cosine and sine of an angle: around an axis, or from it.
struct Angle {
  double cosine, sine;
};

/// The angle of so many turns, 0 <= turns <= 1; error below 1e-15.
inline Angle full_turns(double turns) {
  const auto quarter = static_cast<int>(turns * 4 + 0.5);
  const double a = (turns - quarter * 0.25) * (2 * elementary::pi), z = a * a;  // |a| <= pi / 4
  constexpr double sines[] = {-1.0 / 6,        1.0 / 120,         -1.0 / 5040,         1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800., -1.0 / 1307674368000};
  constexpr double cosines[] = {
      -1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
      -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  double s = 0, c = 0;  // Taylor: sin = a + a z s, cos = 1 + z c
  for (int k = 6; k >= 0; --k) s = sines[k] + z * s;
  for (int k = 7; k >= 0; --k) c = cosines[k] + z * c;
  const double sine = a + a * (z * s), cosine = 1 + z * c;
  const bool odd = quarter % 2 == 1;
  const double x = odd ? -sine : cosine, y = odd ? cosine : sine;
  return quarter == 2 || quarter == 3 ? Angle{-x, -y} : Angle{x, y};
}

/// The direction at an angle `from` the axis and `turns` around it. Two axes across it by Duff et
/// al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
inline Vec3d direction_about(const Vec3d& axis, const Angle& from, double turns) {
  const double sign = std::copysign(1.0, axis.z);
  const double a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  const Vec3d x{1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
  const Vec3d y{b, sign + axis.y * axis.y * a, -axis.y};
  const Angle around = full_turns(turns);
  return x * (from.sine * around.cosine) + y * (from.sine * around.sine) + axis * from.cosine;
}

/// The angle from the axis of a direction with Lambert's density, cosine / pi; 0 <= u < 1.
inline Angle warp_to_cosine(double u) { return {std::sqrt(1 - u), std::sqrt(u)}; }
inline double cosine_density(double cosine) { return cosine / elementary::pi; }

/// The same with the density (n + 1) / (2 pi) cosine^n, a lobe of Phong's (Lafortune and Willems,
/// "Using the modified Phong reflectance model for physically based rendering", 1994).
inline Angle warp_to_power(double u, double n) {
  const double cosine = elementary::pow(1 - u, 1 / (n + 1));
  return {cosine, std::sqrt(std::max(0.0, 1 - cosine * cosine))};
}

inline double power_density(double power, double n) {  // power: cosine^n
  return (n + 1) * power / (2 * elementary::pi);
}

/// The same spread evenly over a cone whose half angle has the cosine 1 - height.
inline Angle warp_to_cone(double u, double height) {
  const double h = u * height;
  return {1 - h, std::sqrt(h * (2 - h))};
}
inline double cone_density(double height) { return 1 / (2 * elementary::pi * height); }

}  // namespace boule
