#pragma once

#include <cmath>

#include "core/math/elementary.h"
#include "core/math/vec.h"
#include "core/math/warp.h"

namespace boule {

/// p -> scale (R p) + shift with a rotation R: it maps spheres to spheres.
struct Similarity {
  Vec3d row_x{1, 0, 0}, row_y{0, 1, 0}, row_z{0, 0, 1};  ///< of R
  double scale = 1;
  Vec3d shift{};

  /// R v, for directions.
  [[nodiscard]] Vec3d rotate(const Vec3d& v) const {
    return {dot(row_x, v), dot(row_y, v), dot(row_z, v)};
  }
  /// scale (R p) + shift, for points.
  [[nodiscard]] Vec3d apply(const Vec3d& p) const { return rotate(p) * scale + shift; }
};

/// First `inner`, then `outer`.
inline Similarity compose(const Similarity& outer, const Similarity& inner) {
  const auto product_row = [&](const Vec3d& row) {
    return inner.row_x * row.x + inner.row_y * row.y + inner.row_z * row.z;
  };
  return {product_row(outer.row_x), product_row(outer.row_y), product_row(outer.row_z),
          outer.scale * inner.scale, outer.apply(inner.shift)};
}

/// The cosine and sine of an angle in degrees: the same bits on every machine, and exact at
/// multiples of 90. NaN where the angle is not finite.
inline Angle turn_of(double degrees) {
  double rest = std::fmod(degrees, 360.0);  // exact, by IEEE 754
  int quarters = 0;
  for (; rest > 45; rest -= 90) ++quarters;
  for (; rest < -45; rest += 90) --quarters;
  // With t = tan(x / 2): cos x = (1 - t^2) / (1 + t^2), sin x = 2 t / (1 + t^2).
  const double half = elementary::tan_acute(std::fabs(rest) * (elementary::pi / 360));
  const double t = rest < 0 ? -half : half, scale = 1 / (1 + t * t);
  const double c = (1 - t * t) * scale, s = 2 * t * scale;
  switch (((quarters % 4) + 4) % 4) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

/// The rotation about the x axis, then about y, then about z, all fixed axes. Angles are in
/// degrees, counter-clockwise as seen from the axis' tip. R = Rz Ry Rx.
inline Similarity rotation(const Vec3d& degrees) {
  const auto [cx, sx] = turn_of(degrees.x);
  const auto [cy, sy] = turn_of(degrees.y);
  const auto [cz, sz] = turn_of(degrees.z);
  const Similarity about_x{{1, 0, 0}, {0, cx, -sx}, {0, sx, cx}, 1, {}};
  const Similarity about_y{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}, 1, {}};
  const Similarity about_z{{cz, -sz, 0}, {sz, cz, 0}, {0, 0, 1}, 1, {}};
  return compose(about_z, compose(about_y, about_x));
}

}  // namespace boule
