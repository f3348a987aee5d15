#pragma once

#include "core/math/geometry.h"
#include "core/scene/light.h"
#include "simd/abi/isa.h"
#include "simd/abi/shading.h"

namespace boule {

/// The intensity with its falloff over the distance.
inline Color intensity_at(const PointLight& light, const Vec3d& point) {
  if (light.falloff == Falloff::none) return light.intensity;
  const Vec3d way = vec_cast<double>(light.position) - point;
  return light.intensity * static_cast<float>(1 / dot(way, way));
}
/// Of the whole sphere as a point at its centre, radiance (radius / distance)^2: what a surface
/// receives that sees all of it.
inline Color intensity_at(const SphereLight& light, const Vec3d& point) {
  const Vec3d way = vec_cast<double>(light.center) - point;
  const auto radius = static_cast<double>(light.radius);
  return light.radiance * static_cast<float>(radius * radius / dot(way, way));
}
inline Color intensity_at(const DirectionalLight& light, const Vec3d&) { return light.intensity; }

/// What shadow rays of many points to a light go to.
ShadowTarget shadow_target(const Light& light);

/// What a light's shadow rays have in common.
Coherence shadow_coherence(const Light& light);

}  // namespace boule
