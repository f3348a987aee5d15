// Rows P0 .. P6.
#include <cmath>

#include "tests/support/hard_rows.h"

namespace boule::test {
namespace {

Plane plane_at(CaseRandom& random, double far, double normal_length) {
  const Vec3f point = far_point(random, far);
  const Vec3d normal = random.direction();
  return {point, vec_cast<float>(normal * normal_length), 0};
}
Plane ordinary_plane(CaseRandom& random, int) {
  const double normal_length = random.uniform(0.5, 2);
  return plane_at(random, 5, normal_length);
}

Vec3d unit_normal(const Plane& plane) {
  const Vec3d n = vec_cast<double>(plane.normal);  // 10^+-30 squared is at home in double
  return n * (1 / length(n));
}

/// A ray from `distance` off the plane's point, in any direction; a quarter of the rays is bounded.
Ray ray_from(CaseRandom& random, const Plane& plane, double distance) {
  const Vec3d away = random.direction();
  const Vec3d dir = random.direction();
  Ray ray;
  ray.org = rounded(vec_cast<double>(plane.point) + away * distance);
  ray.dir = vec_cast<float>(dir);
  if (random.chance(0.25)) ray.tmax = static_cast<float>(random.uniform(0, 2) * distance);
  return ray;
}
Ray ordinary(CaseRandom& random, const Plane& plane, int) { return ray_from(random, plane, 10); }

Ray nearly_parallel(CaseRandom& random, const Plane& plane, int k) {
  const Vec3d n = unit_normal(plane);
  const Vec3d across = random.perpendicular(n);
  Ray ray = ray_from(random, plane, 10);
  ray.dir = vec_cast<float>(across + n * (random.sign() * std::ldexp(1.0, -k)));
  ray.tmax = Ray{}.tmax;
  return ray;
}

Ray from_the_plane(CaseRandom& random, const Plane& plane, int) {
  const Vec3d across = random.perpendicular(unit_normal(plane));
  const Vec3d dir = random.direction();
  Ray ray;
  ray.org = rounded(vec_cast<double>(plane.point) + across * random.uniform(0, 10));
  ray.dir = vec_cast<float>(dir);
  return ray;
}

Plane far_plane(CaseRandom& random, int k) {
  const Vec3d n = random.direction();
  return {vec_cast<float>(n * power_of_ten(k)), vec_cast<float>(n), 0};
}
Plane long_normal(CaseRandom& random, int k) { return plane_at(random, 5, power_of_ten(k)); }

Plane ground_plane(CaseRandom&, int) { return {{0, 0, 0}, {0, 1, 0}, 0}; }

Ray above_ground(CaseRandom& random, const Plane&, int) {
  const double x = random.uniform(-5, 5);
  const double y = random.uniform(0.01, 10);
  const double z = random.uniform(-5, 5);
  Vec3d dir = random.direction();
  if (random.chance(0.5)) dir.y = -random.decade(-6, 0);
  Ray ray;
  ray.org = rounded({x, y, z});
  ray.dir = vec_cast<float>(dir);
  return ray;
}

Plane scaled_plane(CaseRandom& random, int k) { return plane_at(random, 5 * power_of_ten(k), 1); }
Ray scaled(CaseRandom& random, const Plane& plane, int k) {
  return ray_from(random, plane, 10 * power_of_ten(k));
}

constexpr HardRow<Plane> rows[] = {
    {"P0", ordinary_plane, ordinary},
    {"P1", ordinary_plane, nearly_parallel},
    {"P2", [](CaseRandom& random, int k) { return plane_at(random, power_of_ten(k), 1); },
     from_the_plane},
    {"P3", far_plane, ordinary},
    {"P4", long_normal, ordinary},
    {"P5", ground_plane, above_ground},
    {"P6", scaled_plane, scaled},
};

}  // namespace

std::span<const HardRow<Plane>> plane_rows() { return rows; }

}  // namespace boule::test
