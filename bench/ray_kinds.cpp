#include "bench/ray_kinds.h"

#include <cmath>

#include "bench/random4.h"
#include "core/math/geometry.h"
#include "core/surface.h"

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
    const auto numbers = random4(ray, attempt, 11);
    const double a = 2 * numbers[0] - 1, b = 2 * numbers[1] - 1, s = a * a + b * b;
    if (s >= 1) continue;
    const double root = 2 * std::sqrt(1 - s);
    return {a * root, b * root, 1 - 2 * s};
  }
}

/// Whether light from that direction falls on the viewer's side.
bool faces(const Surface& surface, const Vec3d& to_light) {
  return dot(surface.normal, to_light) > 0;
}

/// Adds the ray of this kind from a surface, if there is one; `number` makes it random.
void add_ray(RayKind kind, const BenchScene& scene, const Surface& surface, std::uint32_t number,
             std::vector<Ray>& rays) {
  switch (kind) {
    case RayKind::primary:
      break;
    case RayKind::shadow: {
      const Vec3d light = vec_cast<double>(scene.light.position);
      if (faces(surface, normalize(light - surface.point)))
        rays.push_back(shadow_ray_to(surface, light));
      break;
    }
    case RayKind::mirror:
      rays.push_back(leave(surface, Side::viewer, surface.mirrored));
      break;
    case RayKind::diffuse:
      // The normal plus a random point of the unit sphere is distributed by the cosine.
      rays.push_back(
          leave(surface, Side::viewer, normalize(surface.normal + random_direction(number))));
      break;
    case RayKind::light: {
      const Vec3d center = vec_cast<double>(scene.light.position);
      const Vec3d point = center + random_direction(number) * 0.25;
      if (faces(surface, point - surface.point)) rays.push_back(shadow_ray_to(surface, point));
      break;
    }
  }
}

}  // namespace

std::vector<RayKind> ray_kinds() {
  return {RayKind::primary, RayKind::shadow, RayKind::mirror, RayKind::diffuse, RayKind::light};
}

std::string name_of(RayKind kind) {
  constexpr const char* names[] = {"primary", "shadow", "mirror", "diffuse", "light"};
  return names[static_cast<std::size_t>(kind)];
}

RayBuffer secondary_rays(RayKind kind, const BenchScene& scene, const RayBuffer& primary,
                         const std::vector<Hit>& hits) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, {}, primary.get(i), hits[i]);
    add_ray(kind, scene, surface, static_cast<std::uint32_t>(i), rays);
  }
  return to_buffer(rays);
}

}  // namespace boule::bench
