#include "core/reference.h"

#include <cmath>
#include <limits>

#include "core/math/geometry.h"

namespace boule::reference {
namespace {

constexpr double no_hit = std::numeric_limits<double>::infinity();

constexpr Chord no_chord{std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::quiet_NaN()};

/// Whether t lies in the ray's interval. A t beyond the range of float is a miss, and so is NaN.
bool in_range(double t, const Ray& ray) {
  const bool representable = t <= double{std::numeric_limits<float>::max()};
  return representable && t > ray.tmin && t <= ray.tmax;
}

double first_in_range(const Chord& chord, const Ray& ray) {
  if (in_range(chord.enter, ray)) return chord.enter;
  return in_range(chord.leave, ray) ? chord.leave : no_hit;
}

}  // namespace

bool overlaps(const Chord& chord, const Ray& ray, const Sphere& /*sphere*/) {
  const double end = std::fmin(ray.tmax, double{std::numeric_limits<float>::max()});
  return ray.tmin < ray.tmax && ray.tmin < end && chord.leave > ray.tmin && chord.enter <= end;
}

bool overlaps(const Chord& chord, const Ray& ray, const Plane& /*plane*/) {
  return in_range(chord.enter, ray) || in_range(chord.leave, ray);
}

// Ray-sphere. The lecture substitutes P = O + tD into |P - C|^2 = r^2 and gets the quadratic
//   (D.D) t^2 + 2 (O - C).D t + (O - C).(O - C) - r^2 = 0,
// whose b is even, so the 2s cancel ("the even-b saving"). With f = C - O, a = D.D, b = f.D and
// cc = f.f - r^2 it reads a t^2 - 2 b t + cc = 0, and t = (b -/+ sqrt(b^2 - a cc)) / a.
//
// b^2 - a cc cancels when the sphere is far away or the ray is near the rim. The closest-approach
// form does not (Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing
// Gems chapter 7): with k = b / a the ray comes closest to the centre at O + kD, the vector from
// there to the centre is l = f - kD, and b^2 - a cc = a (r^2 - l.l). The roots then come from
//   q = b + sign(b) sqrt(a (r^2 - l.l)):  cc / q  and  q / a,
// neither of which subtracts nearly equal numbers (Press et al., Numerical Recipes 5.6).
Chord find_chord(const Ray& ray, const Sphere& sphere, bool leaves) {
  const Vec3d d = vec_cast<double>(ray.dir);
  const Vec3d f = vec_cast<double>(sphere.center) - ray.org;
  const double r = sphere.radius;
  const double inverse_a = 1 / dot(d, d);
  const double b = dot(f, d);

  if (leaves) {
    // The origin is on the sphere, so cc = 0 and t = 0 is one root. From the outside the ray moves
    // away from a convex body; from the inside it meets it again at the other root, 2b / a.
    return ray.inside ? Chord{-no_hit, (b + b) * inverse_a} : no_chord;
  }

  const Vec3d l = f - d * (b * inverse_a);
  const double discriminant = r * r - dot(l, l);
  if (!(discriminant >= 0)) return no_chord;  // NaN is a miss; exactly 0, a tangent, is a hit
  const double half_chord = std::sqrt(dot(d, d) * discriminant);
  const double q = std::signbit(b) ? b - half_chord : b + half_chord;
  const double from_a = q * inverse_a;
  // A tangent has one root twice. (From a point on the sphere cc / q is then noise over noise.)
  const double from_cc = discriminant > 0 ? (dot(f, f) - r * r) / q : from_a;
  return from_cc < from_a ? Chord{from_cc, from_a} : Chord{from_a, from_cc};
}

double intersect(const Ray& ray, const Sphere& sphere, bool leaves) {
  return first_in_range(find_chord(ray, sphere, leaves), ray);
}

// Ray-plane. The lecture substitutes P = O + tD into (P - P0).N = 0: t = (P0 - O).N / D.N. D.N = 0
// is a ray along the plane, a miss. A small D.N needs care: products of two floats are exact in
// double, but their sum is rounded, and for a nearly parallel ray that would lose the digits that
// are left after the cancellation. So the error of each addition is computed (Knuth, TAOCP 2,
// 4.2.2) and added at the end.
double denominator(const Vec3d& d, const Vec3d& n) {
  const double xy = d.x * n.x + d.y * n.y, z = d.z * n.z, sum = xy + z;
  const auto error_of = [](double a, double b, double rounded) {
    const double b_part = rounded - a;
    return (a - (rounded - b_part)) + (b - b_part);
  };
  return sum + (error_of(d.x * n.x, d.y * n.y, xy) + error_of(xy, z, sum));
}

Chord find_chord(const Ray& ray, const Plane& plane, bool leaves) {
  if (leaves) return no_chord;  // flat: a ray that leaves it never hits it again
  const Vec3d n = vec_cast<double>(plane.normal);
  const double along = denominator(vec_cast<double>(ray.dir), n);
  if (along == 0 || !std::isfinite(along)) return no_chord;
  const double t = dot(vec_cast<double>(plane.point) - ray.org, n) / along;
  return along < 0 ? Chord{t, no_hit} : Chord{-no_hit, t};
}

double intersect(const Ray& ray, const Plane& plane, bool leaves) {
  return first_in_range(find_chord(ray, plane, leaves), ray);
}

Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes) {
  Hit nearest;
  std::int32_t id = 0;
  const auto offer = [&](const auto& primitive) {
    const double t = intersect(ray, primitive, id == ray.source);
    if (t < nearest.t) nearest = {t, id};  // ids rise, so a tie stays with the lower one
    ++id;
  };
  for (const Sphere& sphere : spheres) offer(sphere);
  for (const Plane& plane : planes) offer(plane);
  return nearest;
}

bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes) {
  return closest_hit(ray, spheres, planes).id != no_primitive;
}

}  // namespace boule::reference
