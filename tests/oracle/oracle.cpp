#include "tests/oracle/oracle.h"

#include <limits>

#include "core/math/vec.h"

namespace boule::test {
namespace {

using BigVec = Vec3<BigFloat>;

template <class T>
BigVec big(const Vec3<T>& v) {
  return {BigFloat(double{v.x}), BigFloat(double{v.y}), BigFloat(double{v.z})};
}

bool is_live(const BigFloat& t, const Ray& ray) {
  const BigFloat largest(double{std::numeric_limits<float>::max()});
  if (!(t <= largest) || !(BigFloat(double{ray.tmin}) < t)) return false;
  return ray.tmax == std::numeric_limits<double>::infinity() || t <= BigFloat(ray.tmax);
}

BigVec at(const Ray& ray, double t) { return big(ray.org) + big(ray.dir) * BigFloat(t); }

}  // namespace

std::optional<OracleRoots> oracle_roots(const Ray& ray, const Sphere& sphere) {
  const BigVec d = big(ray.dir), f = big(sphere.center) - big(ray.org);
  const BigFloat r(double{sphere.radius});
  const BigFloat a = dot(d, d), b = dot(f, d), cc = dot(f, f) - r * r;
  const BigFloat discriminant = b * b - a * cc;
  if (discriminant.sign() < 0) return {};
  const BigFloat half_chord = sqrt(discriminant);
  return OracleRoots{(b - half_chord) / a, (b + half_chord) / a};
}

std::optional<OracleHit> oracle_hit(const Ray& ray, const Sphere& sphere) {
  const auto roots = oracle_roots(ray, sphere);
  if (!roots) return {};
  if (is_live(roots->enter, ray)) return OracleHit{roots->enter, roots->leave};
  if (is_live(roots->leave, ray)) return OracleHit{roots->leave, roots->enter};
  return {};
}

std::optional<OracleHit> oracle_hit(const Ray& ray, const Plane& plane) {
  const BigVec n = big(plane.normal);
  const BigFloat along = dot(big(ray.dir), n);
  if (along.sign() == 0) return {};
  const BigFloat t = dot(big(plane.point) - big(ray.org), n) / along;
  if (!is_live(t, ray)) return {};
  return OracleHit{t, {}};
}

namespace {

/// The chord of a line in a part of a capsule, which may be as short as a point.
struct BigChord {
  std::optional<BigFloat> enter{}, leave{};

  void add(const BigFloat& t) {
    if (!enter || t < *enter) enter = t;
    if (!leave || *leave < t) leave = t;
  }
  /// Adds both roots of a t^2 - 2 b t + c = 0 that `holds` accepts. Precondition: a > 0.
  template <class Holds>
  void add_roots(const BigFloat& a, const BigFloat& b, const BigFloat& c, const Holds& holds) {
    const BigFloat discriminant = b * b - a * c;
    if (discriminant.sign() < 0) return;
    const BigFloat half_chord = sqrt(discriminant);
    for (const BigFloat& t : {(b - half_chord) / a, (b + half_chord) / a}) {
      if (holds(t)) add(t);
    }
  }
};

}  // namespace

// By parts, as a textbook has it: two balls, and the tube between them.
std::optional<OracleHit> oracle_hit(const Ray& ray, const Capsule& capsule) {
  const BigVec d = big(ray.dir), a = big(capsule.a), b = big(capsule.b), u = b - a;
  const BigFloat rr = BigFloat(double{capsule.radius}) * BigFloat(double{capsule.radius});
  BigChord chord;
  const BigVec f = a - big(ray.org);
  for (const BigVec& g : {f, b - big(ray.org)})
    chord.add_roots(dot(d, d), dot(g, d), dot(g, g) - rr, [](const BigFloat&) { return true; });
  // |(t d - f) x u|^2 = r^2 |u|^2, where the foot of the point is on the segment.
  const BigVec n = cross(d, u), m = cross(f, u);
  const BigFloat uu = dot(u, u), zero(0.0);
  if (dot(n, n).sign() > 0) {
    chord.add_roots(dot(n, n), dot(m, n), dot(m, m) - rr * uu, [&](const BigFloat& t) {
      const BigFloat along = dot(d * t - f, u);
      return zero <= along && along <= uu;
    });
  }
  if (!chord.enter) return {};
  if (is_live(*chord.enter, ray)) return OracleHit{*chord.enter, chord.leave};
  if (is_live(*chord.leave, ray)) return OracleHit{*chord.leave, chord.enter};
  return {};
}

std::int32_t oracle_closest(const Ray& ray, std::span<const Sphere> spheres,
                            std::span<const Plane> planes) {
  std::int32_t nearest = no_primitive, id = 0;
  std::optional<BigFloat> nearest_t;
  const auto offer = [&](const auto& primitive) {
    const auto hit = oracle_hit(ray, primitive);
    if (hit && (!nearest_t || hit->t < *nearest_t)) {
      nearest_t = hit->t;
      nearest = id;
    }
    ++id;
  };
  for (const Sphere& sphere : spheres) offer(sphere);
  for (const Plane& plane : planes) offer(plane);
  return nearest;
}

BigFloat oracle_residual(const Ray& ray, const Sphere& sphere, double t) {
  const BigVec from_center = at(ray, t) - big(sphere.center);
  return sqrt(dot(from_center, from_center)) - abs(BigFloat(double{sphere.radius}));
}

BigFloat oracle_residual(const Ray& ray, const Capsule& capsule, double t) {
  const BigVec a = big(capsule.a), u = big(capsule.b) - a, p = at(ray, t) - a;
  const BigFloat along = dot(p, u), uu = dot(u, u);
  BigVec foot = u * BigFloat(0.0);
  if (BigFloat(0.0) < along) foot = along < uu ? u * (along / uu) : u;
  return sqrt(dot(p - foot, p - foot)) - abs(BigFloat(double{capsule.radius}));
}

BigFloat oracle_residual(const Ray& ray, const Plane& plane, double t) {
  const BigVec n = big(plane.normal);
  return dot(at(ray, t) - big(plane.point), n) / sqrt(dot(n, n));
}

}  // namespace boule::test
