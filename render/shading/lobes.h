#pragma once

#include "core/math/color.h"
#include "core/math/sobol.h"
#include "core/surface.h"
#include "render/prepare/flat_material.h"
#include "render/shading/bsdf.h"

namespace boule {

/// A way on from a surface, found by chance.
struct Bounce {
  Vec3d direction;     ///< unit length
  Side side;           ///< of the surface on which it leaves
  Color weight;        ///< what light from there counts: reflectance times cosine over density
  double density = 0;  ///< per solid angle; 0: a mirror's or a refracted ray, the only one there
};

/// A surface as path tracing sees it: its diffuse lobe, its highlight around the mirrored view, its
/// mirror image and what is refracted, each chosen as often as it sends light on. The material is
/// one of conserve_energy().
class Lobes {
 public:
  Lobes(const FlatMaterial& material, const Surface& surface);

  /// True if nothing is sent on.
  [[nodiscard]] bool black() const { return !(sum_ > 0); }

  /// What light of radiance 1 from `to_light`, which the surface faces, sends to the viewer by the
  /// first two lobes: reflectance times cosine, n.l, times pi.
  [[nodiscard]] Color reflected(double cosine, const Vec3d& to_light) const {
    return direct_light(material_, cosine, to_light, surface_.mirrored, gray(1));
  }

  /// The density with which bounce() takes this direction by one of the first two lobes.
  [[nodiscard]] double density(double cosine, const Vec3d& to_light) const;

  /// A way on, by two numbers. A black weight: none.
  [[nodiscard]] Bounce bounce(UnitPair numbers) const;

 private:
  [[nodiscard]] Bounce scattered(const Vec3d& direction) const;

  const FlatMaterial& material_;
  const Surface& surface_;
  Scatter way_;
  double diffuse_, highlight_, reflection_, refraction_;  ///< what each sends on
  double sum_;
};

}  // namespace boule
