#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/scene.h"
#include "render/frame/traced_hit.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// Spheres of radius 0.1 to 0.5 in a cube of side 20 around 0.
inline std::vector<Sphere> sphere_cloud(int count) {
  CaseRandom random(11);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    Sphere sphere;
    sphere.center.x = static_cast<float>(random.uniform(-10, 10));
    sphere.center.y = static_cast<float>(random.uniform(-10, 10));
    sphere.center.z = static_cast<float>(random.uniform(-10, 10));
    sphere.radius = static_cast<float>(random.uniform(0.1, 0.5));
    spheres.push_back(sphere);
  }
  return spheres;
}

/// Rays through that cube, with float origins and directions of any length; some of them end.
inline std::vector<Ray> ray_cloud(std::size_t count) {
  CaseRandom random(12);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * random.uniform(0, 15);
    const Vec3d towards = random.direction() * random.uniform(0.1, 10);
    Ray ray{vec_cast<double>(vec_cast<float>(from)), vec_cast<float>(towards)};
    if (i % 3 == 0) ray.tmin = static_cast<float>(random.uniform(-1, 1));
    if (i % 5 == 0) ray.tmax = static_cast<float>(random.uniform(0, 3));
    rays.push_back(ray);
  }
  return rays;
}

/// A scene of these objects and one material, without camera and lights.
inline Scene objects(std::vector<Sphere> spheres, std::vector<Plane> planes = {}) {
  Scene scene;
  scene.materials = {{"default", Matte{}}};
  scene.spheres = std::move(spheres);
  scene.planes = std::move(planes);
  return scene;
}

inline bool same_bits(const TracedHit& a, const TracedHit& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return std::bit_cast<std::uint64_t>(a.t) == std::bit_cast<std::uint64_t>(b.t) && a.id == b.id &&
         bits(a.normal.x) == bits(b.normal.x) && bits(a.normal.y) == bits(b.normal.y) &&
         bits(a.normal.z) == bits(b.normal.z);
}

/// Hits that differ in any bit; -1 where there are not equally many.
inline int differing_hits(const std::vector<TracedHit>& a, const std::vector<TracedHit>& b) {
  if (a.size() != b.size()) return -1;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += same_bits(a[i], b[i]) ? 0 : 1;
  return count;
}

}  // namespace boule::test
