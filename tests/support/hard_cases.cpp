#include "tests/support/hard_cases.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/math/elementary.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

// No libm that may round otherwise elsewhere: the hashes of hash_test.cpp cover these inputs.

/// 10^k, correctly rounded for |k| <= 22.
double power_of_ten(int k) {
  double power = 1;
  for (int i = 0; i < std::abs(k); ++i) power *= 10;
  return k < 0 ? 1 / power : power;
}

/// A ray from distance F that passes the centre at beta r, along a random axis, both ends rounded
/// to float. Length and interval vary: the answers may not depend on them.
Ray impact(CaseRandom& random, const Sphere& sphere, double distance, double beta) {
  const Vec3d view = random.direction();
  const Vec3d across = random.perpendicular(view);
  const double sine = std::fmin(beta * double{sphere.radius} / distance, 1.0);
  const Vec3d dir = view * std::sqrt(1 - sine * sine) + across * sine;
  const Vec3d org = vec_cast<double>(sphere.center) - view * distance;
  const double scale = random.chance(0.5) ? 1.0 : elementary::pow(2, random.uniform(-3, 3));
  Ray ray;
  ray.org = vec_cast<double>(vec_cast<float>(org));
  ray.dir = vec_cast<float>(dir * scale);
  if (random.chance(0.25)) ray.tmin = static_cast<float>(random.uniform(0, 1.2) * distance / scale);
  if (random.chance(0.25)) ray.tmax = static_cast<float>(random.uniform(0, 2) * distance / scale);
  return ray;
}

Vec3f far_point(CaseRandom& random, double magnitude) {
  const Vec3d direction = random.direction();
  return vec_cast<float>(direction * magnitude);
}

struct SpherePair {
  Sphere sphere;
  double distance, beta;
};

/// The rows that are a sphere seen from distance F with impact parameter beta r.
SpherePair draw_pair(CaseRandom& random, const char* row, int k) {
  const double near = random.uniform(0, 1.2);
  const auto is = [row](const char* name) { return std::strcmp(row, name) == 0; };
  const auto sphere = [](Vec3f center, double radius) {
    return Sphere{center, static_cast<float>(radius), 0};
  };
  if (is("S1")) return {sphere(far_point(random, 1), 1), 2 * power_of_ten(k), near};
  if (is("S3")) return {sphere(far_point(random, 1), power_of_ten(-k)), 3, near};
  if (is("S4") || is("S4b")) {
    const double beta = 1 + random.sign() * std::ldexp(1.0, -k);
    return {sphere(far_point(random, 1), 1), is("S4") ? 10.0 : 1000.0, beta};
  }
  if (is("S10")) return {sphere(far_point(random, power_of_ten(k)), 1), 10, near};
  const double radius = random.uniform(0.5, 2);
  const double distance = random.uniform(3, 30);
  return {sphere(far_point(random, 5), radius), distance, near};
}

/// S2: a ground sphere, the eye within 5 units of its top, half of the rays grazing.
void ground(CaseRandom& random, int k, std::size_t rays, HardCase& out) {
  const double radius = power_of_ten(k);
  out.spheres = {{{0, static_cast<float>(-radius), 0}, static_cast<float>(radius), 0}};
  for (std::size_t i = 0; i < rays; ++i) {
    const double x = random.uniform(-5, 5);
    const double y = random.uniform(0.01, 5);
    const double z = random.uniform(-5, 5);
    Vec3d dir = random.direction();
    if (i % 2 == 0)
      dir = normalize(Vec3d{dir.x, -std::sqrt(2 * y / radius) * random.uniform(0.9, 1.1), dir.z});
    Ray ray;
    ray.org = vec_cast<double>(vec_cast<float>(Vec3d{x, y, z}));
    ray.dir = vec_cast<float>(dir);
    out.rays.push_back(ray);
  }
}

float special_value(CaseRandom& random) {
  constexpr float values[] = {std::numeric_limits<float>::quiet_NaN(),
                              inf,
                              -inf,
                              0.0F,
                              -0.0F,
                              1e-45F,
                              -1e-40F,
                              3e38F,
                              -3e38F,
                              1e19F,
                              -1e19F,
                              1e-19F,
                              1.0F,
                              -1.0F};
  return values[random.below(14)];
}

void spoil(CaseRandom& random, Vec3f& v) {
  for (float* component : {&v.x, &v.y, &v.z}) {
    if (random.chance(0.25)) *component = special_value(random);
  }
}

/// S12: every component replaced by a special value with probability 1/4.
void spoil_all(CaseRandom& random, HardCase& out) {
  for (Sphere& sphere : out.spheres) {
    spoil(random, sphere.center);
    if (random.chance(0.25)) sphere.radius = special_value(random);
  }
  for (Plane& plane : out.planes) {
    spoil(random, plane.point);
    spoil(random, plane.normal);
  }
  for (Ray& ray : out.rays) {
    Vec3f org = vec_cast<float>(ray.org);
    spoil(random, org);
    ray.org = vec_cast<double>(org);
    spoil(random, ray.dir);
    if (random.chance(0.25)) ray.tmin = special_value(random);
    if (random.chance(0.25)) ray.tmax = special_value(random);
  }
}

/// P0 ordinary, P1 n.d = 2^-k, P2 origin on the plane with |p| ~ 10^k.
void plane_pair(CaseRandom& random, const HardCaseSpec& spec, HardCase& out, Plane plane) {
  const Vec3d n = normalize(vec_cast<double>(plane.normal));
  const Vec3d across = random.perpendicular(n);
  const Vec3d away = random.direction();
  Vec3d org = vec_cast<double>(plane.point) + away * 10.0;
  Vec3d dir = random.direction();
  if (std::strcmp(spec.row, "P1") == 0)
    dir = across + n * (random.sign() * std::ldexp(1.0, -spec.k));
  if (std::strcmp(spec.row, "P2") == 0)
    org = vec_cast<double>(plane.point) + across * random.uniform(0, 10);
  Ray ray;
  ray.org = vec_cast<double>(vec_cast<float>(org));
  ray.dir = vec_cast<float>(dir);
  if (random.chance(0.25)) ray.tmax = static_cast<float>(random.uniform(0, 20));
  out.rays.push_back(ray);
}

void planes(CaseRandom& random, const HardCaseSpec& spec, std::size_t count, std::size_t rays,
            HardCase& out) {
  const double magnitude = std::strcmp(spec.row, "P2") == 0 ? power_of_ten(spec.k) : 5;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f point = far_point(random, magnitude);
    const Vec3d normal = random.direction();
    out.planes.push_back({point, vec_cast<float>(normal * random.uniform(0.5, 2)), 0});
  }
  for (std::size_t i = 0; i < rays; ++i) {
    plane_pair(random, spec, out, out.planes[i % out.planes.size()]);
  }
}

/// L: secondary rays, their origins doubles on a sphere or plane, leaving it on either side.
void leaving(CaseRandom& random, int k, HardCase& out) {
  const auto spheres = static_cast<int>(out.spheres.size());
  const auto all = spheres + static_cast<int>(out.planes.size());
  for (Ray& ray : out.rays) {
    const int id = random.below(all);
    ray.source = id;
    Vec3d n = random.direction();
    const Vec3d dir = random.direction();
    Vec3d at;
    if (id < spheres) {
      const Sphere& sphere = out.spheres[static_cast<std::size_t>(id)];
      at = vec_cast<double>(sphere.center) + n * double{sphere.radius};
      ray.inside = dot(n, dir) < 0;
    } else {
      const Plane& plane = out.planes[static_cast<std::size_t>(id - spheres)];
      n = normalize(vec_cast<double>(plane.normal));
      const Vec3d across = random.perpendicular(n);
      at = vec_cast<double>(plane.point) + across * random.uniform(0, power_of_ten(k));
    }
    ray.org = at;
    ray.dir = vec_cast<float>(dir);
    ray.tmin = 0;
    ray.tmax = random.chance(0.25) ? static_cast<float>(random.uniform(0, 2)) : inf;
  }
}

void spheres(CaseRandom& random, const HardCaseSpec& spec, std::size_t count, std::size_t rays,
             HardCase& out) {
  std::vector<SpherePair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    pairs.push_back(draw_pair(random, spec.row, spec.k));
    out.spheres.push_back(pairs.back().sphere);
  }
  for (std::size_t i = 0; i < rays; ++i) {
    const SpherePair& pair = pairs[i % count];
    const SpherePair other = draw_pair(random, spec.row, spec.k);  // fresh distance and beta
    out.rays.push_back(impact(random, pair.sphere, other.distance, other.beta));
  }
}

}  // namespace

std::string name_of(const HardCaseSpec& spec) {
  return std::string(spec.row) + "_k" + std::to_string(spec.k);
}

std::vector<HardCaseSpec> hard_case_specs() {
  std::vector<HardCaseSpec> specs = {{"S0"}, {"S12"}, {"P0"}};
  for (int k = 0; k <= 7; ++k) specs.push_back({"S1", k});
  for (int k = 3; k <= 7; ++k) specs.push_back({"S2", k});
  for (int k = 1; k <= 7; ++k) specs.push_back({"S3", k});
  for (int k = 4; k <= 24; k += 4) specs.push_back({"S4", k});
  for (int k = 4; k <= 24; k += 4) specs.push_back({"S4b", k});
  for (int k = 3; k <= 7; ++k) specs.push_back({"S10", k});
  for (int k = 4; k <= 28; k += 4) specs.push_back({"P1", k});
  for (int k = 0; k <= 6; ++k) specs.push_back({"P2", k});
  for (int k = 0; k <= 6; k += 3) specs.push_back({"L", k});
  return specs;
}

HardCase make_hard_case(const HardCaseSpec& spec, std::size_t primitives, std::size_t rays,
                        std::uint64_t seed) {
  CaseRandom random(seed * 1000003 + static_cast<std::uint64_t>(spec.k) * 131 +
                    static_cast<std::uint64_t>(spec.row[0]) * 17 +
                    static_cast<std::uint64_t>(spec.row[1]));
  HardCase out;
  if (std::strcmp(spec.row, "S2") == 0) {
    ground(random, spec.k, rays, out);
    return out;
  }
  if (spec.row[0] != 'P') spheres(random, spec, primitives, rays, out);
  const bool mixed = std::strcmp(spec.row, "S12") == 0 || spec.row[0] == 'L';
  if (spec.row[0] == 'P') planes(random, spec, primitives, rays, out);
  if (mixed) {
    HardCase more;
    planes(random, {"P0"}, 5, rays / 4, more);
    out.planes = more.planes;
    out.rays.insert(out.rays.end(), more.rays.begin(), more.rays.end());
  }
  if (std::strcmp(spec.row, "S12") == 0) spoil_all(random, out);
  if (spec.row[0] == 'L') leaving(random, spec.k, out);
  return out;
}

}  // namespace boule::test
