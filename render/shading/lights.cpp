#include "render/shading/lights.h"

#include "core/math/geometry.h"

namespace boule {
namespace {

LightSample sample(const PointLight& light, const Vec3d& point) {
  const Vec3d way = vec_cast<double>(light.position) - point;
  const Vec3d to_light = normalize(way);
  if (light.falloff == Falloff::none) return {to_light, light.intensity};
  return {to_light, light.intensity * static_cast<float>(1 / dot(way, way))};
}

LightSample sample(const DirectionalLight& light, const Vec3d&) {
  return {normalize(-vec_cast<double>(light.direction)), light.intensity};
}

Ray shadow(const PointLight& light, const Surface& surface) {
  return shadow_ray_to(surface, vec_cast<double>(light.position));
}

Ray shadow(const DirectionalLight& light, const Surface& surface) {
  return shadow_ray_along(surface, -light.direction);
}

}  // namespace

LightSample sample_light(const Light& light, const Vec3d& point) {
  return std::visit([&](const auto& any) { return sample(any, point); }, light);
}

Ray shadow_ray(const Light& light, const Surface& surface) {
  return std::visit([&](const auto& any) { return shadow(any, surface); }, light);
}

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<PointLight>(light) ? Coherence::common_end
                                                   : Coherence::common_direction;
}

}  // namespace boule
