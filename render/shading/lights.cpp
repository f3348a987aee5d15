#include "render/shading/lights.h"

#include "core/math/geometry.h"

namespace boule {
namespace {

LightSample sample(const PointLight& light, const Vec3d& point) {
  return {normalize(vec_cast<double>(light.position) - point), intensity_at(light, point)};
}

LightSample sample(const DirectionalLight& light, const Vec3d& point) {
  return {normalize(-vec_cast<double>(light.direction)), intensity_at(light, point)};
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
