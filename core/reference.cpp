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

/// Whether a chord of a bounded primitive has a part in the ray's interval.
bool has_part(const Chord& chord, const Ray& ray) {
  const double end = std::fmin(ray.tmax, double{std::numeric_limits<float>::max()});
  return ray.tmin < ray.tmax && ray.tmin < end && chord.leave > ray.tmin && chord.enter <= end;
}

/// The roots of a ball from its discriminant, r^2 - l.l, as find_chord() of a sphere derives them.
Chord roots_of(const Vec3d& d, const Vec3d& f, double r, double b, double discriminant) {
  const double half_chord = std::sqrt(dot(d, d) * discriminant);
  const double q = std::signbit(b) ? b - half_chord : b + half_chord;
  const double from_a = q * (1 / dot(d, d));
  // A tangent has one root twice. (From a point on the sphere cc / q is then noise over noise.)
  const double from_cc = discriminant > 0 ? (dot(f, f) - r * r) / q : from_a;
  return from_cc < from_a ? Chord{from_cc, from_a} : Chord{from_a, from_cc};
}

}  // namespace

bool overlaps(const Chord& chord, const Ray& ray, const Sphere& /*sphere*/) {
  return has_part(chord, ray);
}

bool overlaps(const Chord& chord, const Ray& ray, const Capsule& /*capsule*/) {
  return has_part(chord, ray);
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
  return roots_of(d, f, r, b, discriminant);
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

// Ray-capsule. A capsule is the union of the balls of radius r around the points A + su of a
// segment, u = B - A and 0 <= s <= 1. With l and v, the parts of A - O and u across the ray, the
// ball at s has its centre l + sv away from the ray's line. So the line hits the capsule if it hits
// the ball that comes nearest to it: the s at which |l + sv| is least, moved to the ends of the
// segment.
//
// The line enters the capsule where it enters one of the balls. Over all s, the ball at s is
// entered at b(s) - sqrt(r^2 - |l + sv|^2) along the line, a convex function of s that is least at
//   s* - h cos / |v|,  where s* is the nearest s, h^2 = r^2 - |l + s*v|^2, and cos = u.d / |u| |d|,
// and it leaves the last ball at s* + h cos / |v|; again both are moved to the ends of the segment.
// Where a line runs nearly along the tube, s is known less well, but as the ball is the first one,
// an error in s moves t by the square of that error only.
struct Balls {
  Vec3d d, f, u;  // the ray's direction, A - O, B - A
  double r, inverse_a;

  // The line in the ball at s, which it hits, perhaps but for rounding.
  [[nodiscard]] Chord chord_at(double s) const {
    const Vec3d g = f + u * s;
    const double b = dot(g, d);
    const Vec3d l = g - d * (b * inverse_a);
    const double found = r * r - dot(l, l), discriminant = found < 0 ? 0 : found;
    return roots_of(d, g, r, b, discriminant);
  }
};

double on_segment(double s) { return s > 0 ? (s < 1 ? s : 1.0) : 0.0; }  // NaN: 0

Chord find_chord(const Ray& ray, const Capsule& capsule, bool leaves) {
  if (leaves && !ray.inside) return no_chord;  // convex: a ray that leaves it never hits it again
  const Vec3d d = vec_cast<double>(ray.dir), a = vec_cast<double>(capsule.a);
  const Vec3d f = a - ray.org, u = vec_cast<double>(capsule.b) - a;
  const double r = capsule.radius, inverse_a = 1 / dot(d, d);
  const double along = dot(u, d);
  const Vec3d l = f - d * (dot(f, d) * inverse_a), v = u - d * (along * inverse_a);
  const double vv = dot(v, v);
  const bool is_parallel = !(vv > 0);
  const double nearest = is_parallel ? 0 : -dot(l, v) / vv;

  const Vec3d closest = l + v * on_segment(nearest);
  const double discriminant = r * r - dot(closest, closest);
  // NaN is a miss. A ray that starts on the surface and goes in is in the capsule.
  if (!(discriminant >= 0) && !leaves) return no_chord;

  const Vec3d off_axis = l + v * nearest;
  const double hh = r * r - dot(off_axis, off_axis), h = std::sqrt(hh < 0 ? 0 : hh);
  const double size = std::sqrt(dot(u, u) * vv) * std::sqrt(dot(d, d));
  const double lean = is_parallel ? std::copysign(no_hit, along) : h * along / size;
  const Balls balls{d, f, u, r, inverse_a};
  const double enter = balls.chord_at(on_segment(nearest - lean)).enter;
  const double leave = balls.chord_at(on_segment(nearest + lean)).leave;
  return {leaves ? -no_hit : enter, leave};
}

double intersect(const Ray& ray, const Capsule& capsule, bool leaves) {
  return first_in_range(find_chord(ray, capsule, leaves), ray);
}

Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes,
                std::span<const Capsule> capsules) {
  Hit nearest;
  std::int32_t id = 0;
  const auto offer = [&](const auto& primitive) {
    const double t = intersect(ray, primitive, id == ray.source);
    if (t < nearest.t) nearest = {t, id};  // ids rise, so a tie stays with the lower one
    ++id;
  };
  for (const Sphere& sphere : spheres) offer(sphere);
  for (const Plane& plane : planes) offer(plane);
  for (const Capsule& capsule : capsules) offer(capsule);
  return nearest;
}

bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes,
             std::span<const Capsule> capsules) {
  return closest_hit(ray, spheres, planes, capsules).id != no_primitive;
}

}  // namespace boule::reference
