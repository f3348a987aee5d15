// Rows S0 .. S11. The inputs are hashed, so no libm is used: another may round differently.
#include <cmath>

#include "core/reference.h"
#include "tests/support/hard_rows.h"

namespace boule::test {
namespace {

/// A ray from distance F that passes the centre at beta r, both its ends rounded to float.
Ray aim(CaseRandom& random, const Sphere& sphere, double distance, double beta, double speed = 1) {
  const Vec3d view = random.direction();
  const Vec3d across = random.perpendicular(view);
  const double sine = std::fmin(beta * double{sphere.radius} / distance, 1.0);
  const Vec3d dir = view * std::sqrt(1 - sine * sine) + across * sine;
  Ray ray;
  ray.org = rounded(vec_cast<double>(sphere.center) - view * distance);
  ray.dir = vec_cast<float>(dir * speed);
  return ray;
}

/// As aim(), with the lengths and intervals that the answers may not depend on.
Ray impact(CaseRandom& random, const Sphere& sphere, double distance, double beta) {
  const double speed = random.chance(0.5) ? 1.0 : elementary::pow(2, random.uniform(-3, 3));
  Ray ray = aim(random, sphere, distance, beta, speed);
  if (random.chance(0.25)) ray.tmin = static_cast<float>(random.uniform(0, 1.2) * distance / speed);
  if (random.chance(0.25)) ray.tmax = static_cast<float>(random.uniform(0, 2) * distance / speed);
  return ray;
}

/// From `distance` off the centre, in any direction.
Ray from_near(CaseRandom& random, const Sphere& sphere, double distance) {
  const Vec3d away = random.direction();
  const Vec3d dir = random.direction();
  Ray ray;
  ray.org = rounded(vec_cast<double>(sphere.center) + away * distance);
  ray.dir = vec_cast<float>(dir);
  return ray;
}

Sphere ball(CaseRandom& random, double far, double radius) {
  return {far_point(random, far), static_cast<float>(radius), 0};
}
Sphere unit_ball(CaseRandom& random, int) { return ball(random, 1, 1); }
Sphere far_unit_ball(CaseRandom& random, int k) { return ball(random, power_of_ten(k), 1); }
Sphere ordinary_ball(CaseRandom& random, int) {
  const double radius = random.uniform(0.5, 2);
  return ball(random, 5, radius);
}
Sphere scaled_ball(CaseRandom& random, int k) {
  const double radius = random.uniform(0.5, 2);
  return ball(random, 5 * power_of_ten(k), radius * power_of_ten(k));
}
Sphere ground_ball(CaseRandom&, int k) {
  const auto radius = static_cast<float>(power_of_ten(k));
  return {{0, -radius, 0}, radius, 0};
}

double near_beta(CaseRandom& random) { return random.uniform(0, 1.2); }

Ray ordinary(CaseRandom& random, const Sphere& sphere, int) {
  const double distance = random.uniform(3, 30);
  const double beta = near_beta(random);
  return impact(random, sphere, distance, beta);
}

Ray grazing(CaseRandom& random, const Sphere& ground, int) {
  const double radius = ground.radius;
  const double x = random.uniform(-5, 5);
  const double y = random.uniform(0.01, 5);
  const double z = random.uniform(-5, 5);
  Vec3d dir = random.direction();
  if (random.chance(0.5)) {
    const double slope = -std::sqrt(2 * y / radius) * random.uniform(0.9, 1.1);
    dir = normalize(Vec3d{dir.x, slope, dir.z});
  }
  Ray ray;
  ray.org = rounded({x, y, z});
  ray.dir = vec_cast<float>(dir);
  return ray;
}

Ray tangent(CaseRandom& random, const Sphere& sphere, int k, double distance) {
  const double beta = 1 + random.sign() * std::ldexp(1.0, -k);
  return impact(random, sphere, distance, beta);
}

Ray near_surface(CaseRandom& random, const Sphere& sphere, int k) {
  const double distance = double{sphere.radius} * (1 + random.sign() * std::ldexp(1.0, -k));
  return from_near(random, sphere, distance);
}

Ray of_speed(CaseRandom& random, const Sphere& sphere, int k) {
  const double distance = random.uniform(3, 30);
  const double beta = near_beta(random);
  return aim(random, sphere, distance, beta, power_of_ten(k));
}

Ray from_centre(CaseRandom& random, const Sphere& sphere, int) {
  const Vec3d dir = random.direction();
  const double speed = random.decade(-3, 3);
  return {vec_cast<double>(sphere.center), vec_cast<float>(dir * speed)};
}

Ray scaled(CaseRandom& random, const Sphere& sphere, int k) {
  const double distance = random.uniform(3, 30) * power_of_ten(k);
  const double beta = near_beta(random);
  return aim(random, sphere, distance, beta);
}

/// The origin of a secondary ray, as shading makes it: p64 = o + t64 d, moved along n.
Ray secondary(CaseRandom& random, const Sphere& ground, int k) {
  Ray in = grazing(random, ground, k);
  double t = reference::intersect(in, ground, false);
  if (!std::isfinite(t)) {
    in.dir = {0, -1, 0};
    t = reference::intersect(in, ground, false);
  }
  const Vec3d center = vec_cast<double>(ground.center);
  const Vec3d point = in.org + vec_cast<double>(in.dir) * t;
  const Vec3d n = normalize(point - center);
  const bool inward = random.chance(0.25);
  Vec3d dir = random.direction();
  if ((dot(dir, n) < 0) != inward) dir = -dir;
  const double reach = length(center - in.org) + double{ground.radius};
  const double move = (std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z)) * 0x1p-49 * reach;
  Ray out;
  out.org = point + n * (inward ? -move : move);
  out.dir = vec_cast<float>(dir);
  out.source = 0;
  out.inside = inward;
  return out;
}

constexpr HardRow<Sphere> rows[] = {
    {"S0", ordinary_ball, ordinary},
    {"S1", unit_ball,
     [](CaseRandom& random, const Sphere& sphere, int k) {
       const double beta = near_beta(random);
       return impact(random, sphere, 2 * power_of_ten(k), beta);
     }},
    {"S2", ground_ball, grazing},
    {"S3", [](CaseRandom& random, int k) { return ball(random, 1, power_of_ten(-k)); },
     [](CaseRandom& random, const Sphere& sphere, int) {
       const double beta = near_beta(random);
       return impact(random, sphere, 3, beta);
     }},
    {"S4", unit_ball,
     [](CaseRandom& random, const Sphere& sphere, int k) {
       return tangent(random, sphere, k, 10);
     }},
    {"S4b", unit_ball,
     [](CaseRandom& random, const Sphere& sphere, int k) {
       return tangent(random, sphere, k, 1000);
     }},
    {"S5", far_unit_ball,
     [](CaseRandom& random, const Sphere& sphere, int) { return from_near(random, sphere, 1); }},
    {"S6", ordinary_ball, near_surface},
    {"S7",
     [](CaseRandom& random, int) {
       const double radius = random.decade(-3, 3);
       return ball(random, 5, radius);
     },
     from_centre},
    {"S8", ordinary_ball, of_speed},
    {"S9", scaled_ball, scaled},
    {"S10", far_unit_ball,
     [](CaseRandom& random, const Sphere& sphere, int) {
       const double beta = near_beta(random);
       return impact(random, sphere, 10, beta);
     }},
    {"S11", ground_ball, secondary},
    {"S13",
     [](CaseRandom& random, int) {
       const double radius = 0x1p64 * random.uniform(0.98, 1);
       return ball(random, radius, radius);
     },
     [](CaseRandom& random, const Sphere& sphere, int k) {
       const double beta = random.uniform(0.95, 1.02);
       return aim(random, sphere, 4 * double{sphere.radius} * power_of_ten(k), beta);
     }},
};

}  // namespace

std::span<const HardRow<Sphere>> sphere_rows() { return rows; }

}  // namespace boule::test
