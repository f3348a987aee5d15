#include "render/prepare/area_lights.h"

#include <algorithm>

#include "core/math/interval.h"

namespace boule {
namespace {

/// The power of a light, but for a factor that is the same for all.
double power_of(const AreaLight& light) {
  return component_sum(light.radiance) * light.radius * light.radius;
}

AreaLight area_light(const Vec3f& center, float radius, const Color& radiance) {
  return {vec_cast<double>(center), static_cast<double>(radius), radiance, 0};
}

}  // namespace

AreaLights::AreaLights(const std::vector<Light>& lights, const std::vector<Sphere>& spheres,
                       const std::vector<Material>& materials) {
  const auto add = [this](const AreaLight& light) {
    if (is_black(light.radiance)) return;
    lights_.push_back(light);
    power_ += power_of(light);
  };
  for (const Light& light : lights) {
    const auto* sphere = std::get_if<SphereLight>(&light);
    if (sphere) add(area_light(sphere->center, sphere->radius, sphere->radiance));
  }
  sphere_lights_ = lights_.size();
  for (const Sphere& sphere : spheres) {
    const Material& material = materials[sphere.material.index()];
    if (!std::holds_alternative<Emissive>(material)) continue;
    const auto emissive = std::get<Emissive>(
        sphere.material.has_color() ? recolored(material, linear_of(sphere.material.color()))
                                    : material);
    add(area_light(sphere.center, sphere.radius, emissive.radiance));
  }
  double sum = 0;
  for (AreaLight& light : lights_) {
    light.share = share_of(light);
    cumulative_.push_back(sum += light.share);
  }
}

double AreaLights::share_of(const AreaLight& light) const {
  return 0.5 * (power_of(light) / power_ + 1 / static_cast<double>(lights_.size()));
}

AreaLight AreaLights::light_of(const Sphere& sphere, const Color& radiance) const {
  AreaLight light = area_light(sphere.center, sphere.radius, radiance);
  light.share = share_of(light);
  return light;
}

}  // namespace boule
