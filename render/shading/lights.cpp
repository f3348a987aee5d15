#include "render/shading/lights.h"

#include <variant>

#include "core/math/geometry.h"

namespace boule {

namespace {

ShadowTarget point_target(const Vec3f& p) {
  return {false, {double{p.x}, double{p.y}, double{p.z}}, {}};
}
ShadowTarget target_of(const PointLight& light) { return point_target(light.position); }
ShadowTarget target_of(const SphereLight& light) { return point_target(light.center); }
ShadowTarget target_of(const DirectionalLight& light) {
  const Vec3d to_light = normalize(-vec_cast<double>(light.direction));
  const Vec3f dir = -light.direction;
  return {true, {to_light.x, to_light.y, to_light.z}, {dir.x, dir.y, dir.z}};
}

LightIntensity constant(const Color& intensity) {
  return {{intensity.r, intensity.g, intensity.b}, false, {}, 0};
}
LightIntensity falling_off(const Color& intensity, const Vec3f& p, double strength) {
  return {{intensity.r, intensity.g, intensity.b},
          true,
          {double{p.x}, double{p.y}, double{p.z}},
          strength};
}
LightIntensity intensity_of(const PointLight& light) {
  if (light.falloff == Falloff::none) return constant(light.intensity);
  return falling_off(light.intensity, light.position, 1);
}
LightIntensity intensity_of(const SphereLight& light) {
  return falling_off(light.radiance, light.center, double{light.radius} * double{light.radius});
}
LightIntensity intensity_of(const DirectionalLight& light) { return constant(light.intensity); }

}  // namespace

LightIntensity light_intensity(const Light& light) {
  return std::visit([](const auto& any) { return intensity_of(any); }, light);
}

ShadowTarget shadow_target(const Light& light) {
  return std::visit([](const auto& any) { return target_of(any); }, light);
}

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) ? Coherence::common_direction
                                                         : Coherence::common_end;
}

}  // namespace boule
