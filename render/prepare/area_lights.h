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
  double share;  ///< how often it is picked
};

/// All of a scene's. Half of the time one is picked by its power, else any: what is strong but far
/// away, or all around, must not leave nothing for the others. Black ones are none. Preconditions,
/// not checked: of a valid scene; nothing is picked where there is nothing.
class AreaLights {
 public:
  AreaLights() = default;
  /// Throws std::bad_alloc.
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
  [[nodiscard]] double share_of(const AreaLight& light) const;

  std::vector<AreaLight> lights_;   ///< sphere lights, then emissive spheres
  std::vector<double> cumulative_;  ///< shares up to and with each
  std::size_t sphere_lights_ = 0;
  double power_ = 0;
};

}  // namespace boule
