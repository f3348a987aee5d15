#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// An emitting sphere: a sphere light or an emissive sphere.
struct AreaLight {
  Vec3d center;
  double radius;
  Color radiance;
  double share;  ///< the probability of picking it
};

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

  [[nodiscard]] bool empty() const { return lights_.empty(); }

  [[nodiscard]] std::size_t size() const { return lights_.size(); }
  /// Light i is picked by a number u in [0, 1) from before(i) up to before(i + 1).
  [[nodiscard]] const AreaLight& operator[](std::size_t i) const { return lights_[i]; }
  [[nodiscard]] double before(std::size_t i) const { return i == 0 ? 0 : cumulative_[i - 1]; }

  /// The number of sphere lights, which come first, in file order. They are not objects: rays pass
  /// through them.
  [[nodiscard]] std::size_t sphere_light_count() const { return sphere_lights_; }

  /// An emissive sphere of the scene as a light. `radiance` is that of its material, and not black.
  [[nodiscard]] AreaLight light_of(const Sphere& sphere, const Color& radiance) const;

 private:
  [[nodiscard]] double share_of(const AreaLight& light) const;

  std::vector<AreaLight> lights_;   ///< sphere lights, then emissive spheres
  std::vector<double> cumulative_;  ///< sums of the shares up to and including each
  std::size_t sphere_lights_ = 0;
  double power_ = 0;
};

}  // namespace boule
