#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// A chord in long double; `unsure`: the line is so close to the rim that rounding decides.
struct LongChord {
  bool met, unsure;
  long double enter, leave;
};
inline LongChord long_chord(const Ray& ray, const Sphere& sphere) {
  const auto d = vec_cast<long double>(ray.dir);
  const auto f = vec_cast<long double>(sphere.center) - vec_cast<long double>(ray.org);
  const long double r = sphere.radius, a = dot(d, d), middle = dot(f, d) / a;
  const auto aside = f - d * middle;
  const long double rest = r * r - dot(aside, aside);
  const long double doubt = 1e-13L * (r * r + dot(f, f));
  const long double half = std::sqrt(std::fmax(rest, 0.0L) / a);
  return {rest >= 0, std::fabs(rest) < doubt, middle - half, middle + half};
}

struct SphereCase {
  std::string name;
  std::vector<Sphere> spheres;
  double spread;
};
/// Spheres that overlap, lie in each other, coincide, and are far from 0 for their size.
inline std::vector<SphereCase> sphere_cases() {
  CaseRandom random(61);

  const auto point = [&](double spread) {
    const double x = random.uniform(-spread, spread), y = random.uniform(-spread, spread);
    return Vec3f{static_cast<float>(x), static_cast<float>(y),
                 static_cast<float>(random.uniform(-spread, spread))};
  };
  SphereCase overlapping{"overlapping", {}, 2}, nested{"nested", {}, 2},
      coincident{"coincident", {}, 2}, far{"far", {}, 2};
  for (int i = 0; i < 400; ++i) {
    const auto r = static_cast<float>(random.uniform(0.05, 0.5));
    overlapping.spheres.push_back({point(1), r});
    nested.spheres.push_back({point(0.05), static_cast<float>(random.uniform(0.1, 1.5))});
    coincident.spheres.push_back({{static_cast<float>(i % 40) / 40, 0, 0}, 0.3F});
    const Vec3f near = point(1);
    far.spheres.push_back({{near.x + 1000, near.y - 2000, near.z + 3000}, r});
  }
  return {overlapping, nested, coincident, far};
}

inline std::vector<Ray> rays_of(const SphereCase& scene, int count) {
  CaseRandom random(62);
  const Vec3d middle = scene.name == "far" ? Vec3d{1000, -2000, 3000} : Vec3d{};
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * (random.uniform(0, 1) * scene.spread);
    Ray ray{middle + from, vec_cast<float>(random.direction() * random.uniform(0.5, 2))};
    if (i % 3 == 0) ray.tmin = random.uniform(-2, 1);
    if (i % 4 == 0) ray.tmax = random.uniform(0, 3);
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace boule::test
