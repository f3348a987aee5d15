#include "bench/peers/rays.h"

#include <cmath>

#include "core/math/geometry.h"
#include "core/math/random.h"
#include "render/shading/bsdf.h"
#include "render/shading/lights.h"
#include "render/shading/surface.h"

namespace boule::bench {
namespace {

RayBuffer to_buffer(const std::vector<Ray>& rays) {
  RayBuffer buffer(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) buffer.set(i, rays[i]);
  return buffer;
}

/// A random point of the unit sphere (Marsaglia 1972): only + - * and roots.
Vec3d random_direction(std::uint32_t ray) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const auto numbers = random4(ray, attempt, 0, 0, 11);
    const double a = 2 * numbers[0] - 1, b = 2 * numbers[1] - 1, s = a * a + b * b;
    if (s >= 1) continue;
    const double root = 2 * std::sqrt(1 - s);
    return {a * root, b * root, 1 - 2 * s};
  }
}

}  // namespace

std::string name_of(RayKind kind) {
  switch (kind) {
    case RayKind::primary:
      return "primary";
    case RayKind::shadow:
      return "shadow";
    case RayKind::diffuse:
      return "diffuse";
  }
  return {};
}

RayBuffer shadow_rays(const BenchScene& scene, const RayBuffer& primary,
                      const std::vector<Hit>& hits) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, {}, primary.get(i), hits[i]);
    if (!faces(surface, sample_light(scene.light, surface.point).to_light)) continue;
    rays.push_back(shadow_ray(scene.light, surface));
  }
  return to_buffer(rays);
}

/// The normal plus a random point of the unit sphere is distributed by the cosine.
RayBuffer diffuse_rays(const BenchScene& scene, const RayBuffer& primary,
                       const std::vector<Hit>& hits) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, {}, primary.get(i), hits[i]);
    const Vec3d bounce = surface.normal + random_direction(static_cast<std::uint32_t>(i));
    rays.push_back(leave(surface, Side::viewer, normalize(bounce)));
  }
  return to_buffer(rays);
}

}  // namespace boule::bench
