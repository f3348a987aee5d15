#pragma once

#include <cmath>

#include "core/math/ray.h"
#include "tests/support/long_double_tracer.h"

/// The formulas of core/math and core/optics a second time: in long double, by angles, rotations
/// and the standard library's functions, sharing nothing with core but plain values.
namespace boule::test {

inline constexpr long double pi_l = 3.14159265358979323846264338L;

inline Vec3l cross_l(const Vec3l& a, const Vec3l& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v, turned by the smallest rotation that takes the unit vector `from` to the unit vector `to`
/// (Rodrigues' formula).
inline Vec3l turned(const Vec3l& v, const Vec3l& from, const Vec3l& to) {
  const Vec3l axis = cross_l(from, to);
  const long double cosine = dot(from, to);
  return v * cosine + cross_l(axis, v) + axis * (dot(axis, v) / (1 + cosine));
}

/// The direction `angle` from the axis and `around` it, in radians: of the pole nearer to the axis
/// first, from the x axis counter-clockwise as seen from outside, and turned with the pole.
inline Vec3l direction_about_l(const Vec3d& axis, long double angle, long double around) {
  const long double pole = std::signbit(axis.z) ? -1 : 1;
  const Vec3l at_pole{std::sin(angle) * std::cos(around), pole * std::sin(angle) * std::sin(around),
                      pole * std::cos(angle)};
  return turned(at_pole, {0, 0, pole}, vec_cast<long double>(axis));
}

/// A sphere as a point outside of it sees it.
struct LightConeL {
  Vec3l axis;
  long double distance, radius;

  LightConeL(const Vec3d& point, const Vec3d& center, double r) : radius(r) {
    const Vec3l way = vec_cast<long double>(center) - vec_cast<long double>(point);
    distance = length(way);
    axis = unit(way);
  }

  [[nodiscard]] long double half_angle() const { return std::asin(radius / distance); }

  /// 2 pi (1 - cos a) = 4 pi sin^2 (a / 2).
  [[nodiscard]] long double solid_angle() const {
    const long double sine = std::sin(half_angle() / 2);
    return 4 * pi_l * sine * sine;
  }

  /// The angle from the axis within which a share u of the solid angle lies.
  [[nodiscard]] long double angle_of(long double u) const {
    return 2 * std::asin(std::sqrt(u) * std::sin(half_angle() / 2));
  }

  /// Where a line begins to meet the sphere that passes its centre 2 u distances nearer than this
  /// direction does, less 4 u of the way.
  [[nodiscard]] long double free_distance(const Vec3d& direction) const {
    const long double sine = length(cross_l(vec_cast<long double>(direction), axis));
    const long double angle = std::asin(std::fmax(sine - 0x1p-23L, 0.0L));
    const long double inner = distance * std::sin(angle) / radius;  // sine of the angle at the hit
    return (distance * std::cos(angle) - radius * std::cos(std::asin(inner))) * (1 - 0x1p-22L);
  }
};

/// A point of the disc by its radius and angle: squares become circles, a quarter of the circle for
/// each of their sides, x and y in -1 .. 1.
struct DiscPointL {
  long double x, y;
};
inline DiscPointL disc_point_l(long double x, long double y) {
  const bool sides = std::fabs(x) > std::fabs(y);
  const long double radius = sides ? x : y;
  if (radius == 0) return {0, 0};
  const long double angle = sides ? pi_l / 4 * (y / x) : pi_l / 2 - pi_l / 4 * (x / y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// How light goes on from a point where a ray of this direction met what has the unit normal
/// `outward` there.
struct IncidenceL {
  Vec3l normal, view, mirrored;
  long double cosine;

  IncidenceL(const Vec3f& dir, const Vec3l& outward, bool inner)
      : normal(inner ? -outward : outward), view(unit(vec_cast<long double>(dir))) {
    // What of the view runs along the surface goes on, and the rest turns back.
    const Vec3l along = cross_l(cross_l(normal, view), normal);
    cosine = -dot(normal, view);
    mirrored = along + normal * cosine;
  }
};

/// How far a hit is moved along its normal, axis by axis, given what made it: eight times the
/// rounding of those distances in double.
inline Vec3l departure_step(const Vec3l& normal, long double reach) {
  const long double sum = std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z);
  return normal * (sum * reach * 8 * 0x1p-52L);
}

}  // namespace boule::test
