#include "bench/scenes/ray_kinds.h"

#include <cmath>

#include "bench/scenes/camera_rays.h"
#include "bench/scenes/random4.h"
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

/// A random direction distributed by the cosine: the normal plus a point of the unit sphere.
Vec3d bounce(const Surface& surface, std::uint32_t number) {
  return normalize(surface.normal + random_direction(number));
}

/// Adds the ray of this kind from a surface, if there is one; `number` makes it random.
void add_ray(RayKind kind, const BenchScene& scene, const Surface& surface, std::uint32_t number,
             std::vector<Ray>& rays) {
  switch (kind) {
    case RayKind::primary:
    case RayKind::orthographic:
    case RayKind::chord:
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
      rays.push_back(leave(surface, Side::viewer, bounce(surface, number)));
      break;
    case RayKind::light: {
      const Vec3d center = vec_cast<double>(scene.light.position);
      const Vec3d point = center + random_direction(number) * 0.25;
      if (faces(surface, point - surface.point)) rays.push_back(shadow_ray_to(surface, point));
      break;
    }
    case RayKind::ambient:
      rays.push_back(leave(surface, Side::viewer, bounce(surface, number)));
      rays.back().tmax = scene.radius / 10;
      break;
  }
}

RayBuffer chords(const BenchScene& scene, std::size_t count) {
  const Vec3d center = vec_cast<double>(scene.camera.pose.look_at);
  const auto end_of = [&](std::size_t i) {
    return center + random_direction(static_cast<std::uint32_t>(i)) * double{scene.radius};
  };
  RayBuffer rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d org = end_of(2 * i);
    rays.set(i, {org, vec_cast<float>(end_of(2 * i + 1) - org)});
  }
  return rays;
}

}  // namespace

std::vector<RayKind> ray_kinds() {
  return {RayKind::primary, RayKind::shadow,  RayKind::mirror,       RayKind::diffuse,
          RayKind::light,   RayKind::ambient, RayKind::orthographic, RayKind::chord};
}

std::string name_of(RayKind kind) {
  constexpr const char* names[] = {"primary", "shadow",  "mirror",       "diffuse",
                                   "light",   "ambient", "orthographic", "chord"};
  return names[static_cast<std::size_t>(kind)];
}

Coherence coherence_of(RayKind kind) {
  switch (kind) {
    case RayKind::primary:
      return Coherence::common_origin;
    case RayKind::orthographic:
      return Coherence::common_direction;
    case RayKind::shadow:
      return Coherence::common_end;
    case RayKind::mirror:
    case RayKind::diffuse:
    case RayKind::light:
    case RayKind::ambient:
    case RayKind::chord:
      break;
  }
  return Coherence::none;
}

RayBuffer make_rays(RayKind kind, const BenchScene& scene, const PrimaryRays& primary) {
  if (kind == RayKind::orthographic) return parallel_rays(scene, primary.side);
  if (kind == RayKind::chord) return chords(scene, primary.rays->size());
  std::vector<Ray> rays;
  const std::vector<Hit>& hits = *primary.hits;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].id == no_primitive) continue;
    const Ray ray = primary.rays->get(i);
    const Surface surface = with_primitive(
        scene, hits[i].id, [&](const auto& met) { return find_surface(met, ray, hits[i]); });
    add_ray(kind, scene, surface, static_cast<std::uint32_t>(i), rays);
  }
  return to_buffer(rays);
}

}  // namespace boule::bench
