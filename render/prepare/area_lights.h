#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// A sphere that gives light: a sphere light, or an emissive sphere of the scene.
struct AreaLight {
  Vec3d center;
  double radius;
  Color radiance;
  double share;  ///< how often it is picked: its power over that of all
};

/// All of a scene's, each picked as often as its power demands. Black ones are none.
class AreaLights {
 public:
  AreaLights() = default;
  explicit AreaLights(const Scene& scene);

  [[nodiscard]] bool empty() const { return lights_.empty(); }

  /// A light by a number in [0, 1); u becomes another such number, as evenly spread.
  [[nodiscard]] const AreaLight& pick(double& u) const;

  /// The sphere lights, in file order: no ray meets them.
  [[nodiscard]] const AreaLight* sphere_lights() const { return lights_.data(); }
  [[nodiscard]] std::size_t sphere_light_count() const { return sphere_lights_; }

  /// The emissive sphere as a light; `radiance` is its material's, not black.
  [[nodiscard]] AreaLight light_of(const Sphere& sphere, const Color& radiance) const;

 private:
  std::vector<AreaLight> lights_;   ///< sphere lights, then emissive spheres
  std::vector<double> cumulative_;  ///< power up to and with each, over that of all
  std::size_t sphere_lights_ = 0;
  double power_ = 0;
};

}  // namespace boule
