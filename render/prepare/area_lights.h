#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/scene.h"
#include "simd/abi/paths.h"

namespace boule {

/// The area lights of a scene, without black ones. One of them is picked by its power in half of
/// the cases, and evenly in the other half. So a light that is strong but far away, or all around,
/// leaves samples to the others.
class AreaLights {
 public:
  AreaLights() = default;
  /// Preconditions: the arguments are those of a valid scene, and each sphere's material is among
  /// `materials`.
  AreaLights(const std::vector<Light>& lights, const std::vector<Sphere>& spheres,
             const std::vector<Material>& materials);

  [[nodiscard]] bool empty() const { return all_.empty(); }
  /// Sphere lights, then emissive spheres.
  [[nodiscard]] const std::vector<LightSphere>& all() const { return all_; }

  /// The number of sphere lights, which come first, in file order. They are not objects: rays pass
  /// through them.
  [[nodiscard]] std::size_t sphere_light_count() const { return sphere_lights_; }

  /// The probability of picking an emissive sphere of the scene. `radiance` is that of its
  /// material, and not black.
  [[nodiscard]] double share_of(const Sphere& sphere, const Color& radiance) const;

 private:
  [[nodiscard]] double share_of(const LightSphere& light) const;

  std::vector<LightSphere> all_;
  std::size_t sphere_lights_ = 0;
  double power_ = 0;
};

}  // namespace boule
