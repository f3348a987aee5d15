#include "bench/errors/float_remedies.h"

#include <algorithm>
#include <cmath>

namespace boule::bench {
namespace {

constexpr FloatRemedy remedies[] = {
    {"none"},
    {"t > 1e-6", 1e-6f},
    {"t > 1e-3", 1e-3f},
    {"1e-4 along N", 0, 1e-4f},
    {"1e-3 along N", 0, 1e-3f},
    {"1e-4 to light", 0, 0, 1e-4f},
    {"1e-3 to light", 0, 0, 1e-3f},
};

/// org + t h, least < t < end; h of unit length.
struct FloatRay {
  Vec3f org, h;
  float least, end;

  [[nodiscard]] bool holds(float t) const { return t > least && t < end; }
};

bool meets(const FloatRay& ray, const Sphere& sphere) {
  const Vec3f f = sphere.center - ray.org;
  const float b = dot(f, ray.h);
  const Vec3f l = f - ray.h * b;
  const float discriminant = sphere.radius * sphere.radius - dot(l, l);
  if (!(discriminant >= 0)) return false;
  const float q = b + std::copysign(std::sqrt(discriminant), b);
  return ray.holds((dot(f, f) - sphere.radius * sphere.radius) / q) || ray.holds(q);
}

bool meets(const FloatRay& ray, const Plane& plane) {
  return ray.holds(dot(plane.point - ray.org, plane.normal) / dot(ray.h, plane.normal));
}

/// The shadow ray of a remedy: its origin moved, its direction and length what remains.
FloatRay shadow_ray(const FloatRemedy& remedy, const FloatPoint& from, const Vec3f& light) {
  const Vec3f org = from.point + from.normal * remedy.along_normal;
  const Vec3f way = light - org;
  const float distance = std::sqrt(dot(way, way));
  const Vec3f h = way * (1 / distance);
  return {org + h * remedy.towards_light, h, remedy.least_t, distance - remedy.towards_light};
}

}  // namespace

std::span<const FloatRemedy> float_remedies() { return remedies; }

bool is_shadowed(const FloatRemedy& remedy, const Scene& scene, const FloatPoint& from,
                 const Vec3f& light) {
  const FloatRay ray = shadow_ray(remedy, from, light);
  const auto met = [&](const auto& primitive) { return meets(ray, primitive); };
  return std::any_of(scene.spheres.begin(), scene.spheres.end(), met) ||
         std::any_of(scene.planes.begin(), scene.planes.end(), met);
}

}  // namespace boule::bench
