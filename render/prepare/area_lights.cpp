#include "render/prepare/area_lights.h"

#include <algorithm>

#include "core/math/interval.h"

namespace boule {
namespace {

/// The power of a light, but for a factor that is the same for all.
double power_of(const LightSphere& light) {
  const auto& [r, g, b] = light.radiance;
  return component_sum({r, g, b}) * light.radius * light.radius;
}

LightSphere light_sphere(const Vec3f& center, float radius, const Color& radiance) {
  return {{double{center.x}, double{center.y}, double{center.z}},
          double{radius},
          0,
          0,
          {radiance.r, radiance.g, radiance.b}};
}

}  // namespace

AreaLights::AreaLights(const std::vector<Light>& lights, const std::vector<Sphere>& spheres,
                       const std::vector<Material>& materials) {
  const auto add = [this](const Vec3f& center, float radius, const Color& radiance) {
    if (is_black(radiance)) return;
    all_.push_back(light_sphere(center, radius, radiance));
    power_ += power_of(all_.back());
  };
  for (const Light& light : lights) {
    const auto* sphere = std::get_if<SphereLight>(&light);
    if (sphere) add(sphere->center, sphere->radius, sphere->radiance);
  }
  sphere_lights_ = all_.size();
  for (const Sphere& sphere : spheres) {
    const Material& material = materials[sphere.material.index()];
    if (!std::holds_alternative<Emissive>(material)) continue;
    const auto emissive = std::get<Emissive>(
        sphere.material.has_color() ? recolored(material, linear_of(sphere.material.color()))
                                    : material);
    add(sphere.center, sphere.radius, emissive.radiance);
  }
  double sum = 0;
  for (LightSphere& light : all_) {
    light.share = share_of(light);
    light.before = sum;
    sum += light.share;
  }
}

double AreaLights::share_of(const LightSphere& light) const {
  return 0.5 * (power_of(light) / power_ + 1 / static_cast<double>(all_.size()));
}

double AreaLights::share_of(const Sphere& sphere, const Color& radiance) const {
  return share_of(light_sphere(sphere.center, sphere.radius, radiance));
}

}  // namespace boule
