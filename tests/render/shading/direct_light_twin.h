#pragma once

#include "core/math/geometry.h"
#include "core/scene/light.h"
#include "render/shading/bsdf.h"

namespace boule::test {

/// Direct light by scalar formulas, point by point: what KernelTable::add_direct_light() adds.

/// The intensity with its falloff over the distance.
inline Color intensity_at(const PointLight& light, const Vec3d& point) {
  if (light.falloff == Falloff::none) return light.intensity;
  const Vec3d way = vec_cast<double>(light.position) - point;
  return light.intensity * static_cast<float>(1 / dot(way, way));
}
inline Color intensity_at(const SphereLight& light, const Vec3d& point) {
  const Vec3d way = vec_cast<double>(light.center) - point;
  const auto radius = static_cast<double>(light.radius);
  return light.radiance * static_cast<float>(radius * radius / dot(way, way));
}
inline Color intensity_at(const DirectionalLight& light, const Vec3d&) { return light.intensity; }

/// The light that a surface sends to the viewer when light of `intensity` arrives from the unit
/// direction `to_light`. Precondition: n.l > 0.
inline Color direct_light(const FlatMaterial& material, double n_dot_l, const Vec3d& to_light,
                          const Vec3d& mirrored, const Color& intensity) {
  const CoefficientsOf<double> flat = coefficients(material);
  const double power = highlight_power(flat, mirrored, to_light);
  const float share = material.cosine_highlight ? static_cast<float>(n_dot_l) : 1.0F;
  return color_of(reflected_light(flat, n_dot_l, power, share, vector_of(intensity)));
}

}  // namespace boule::test
