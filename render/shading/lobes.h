#pragma once

#include "core/math/color.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
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
/// one of conserve_energy() and must outlive it.
class Lobes {
 public:
  enum class Lobe { none, diffuse, highlight, reflection, refraction };
  /// A lobe, and for the first two where in it: at an angle from its axis, and so many turns
  /// around.
  struct Choice {
    Lobe lobe = Lobe::none;
    Angle from{};
    double turns = 0;
  };

  Lobes(const FlatMaterial& material, const Surface& surface);

  /// True if nothing is sent on.
  [[nodiscard]] bool black() const { return !(sum_ > 0); }

  /// What light of radiance 1 from `to_light`, which the surface faces, sends to the viewer by the
  /// first two lobes: reflectance times cosine, n.l, times pi.
  [[nodiscard]] Color reflected(double cosine, const Vec3d& to_light) const {
    return direct_light(*material_, cosine, to_light, mirrored_, gray(1));
  }

  /// The density with which this direction is taken by one of the first two lobes.
  [[nodiscard]] double density(double cosine, const Vec3d& to_light) const;

  /// A way on, by two numbers.
  [[nodiscard]] Choice choose(UnitPair numbers) const;

  /// Where the chosen direction is counted from: direction_about(axis(choice), from, turns).
  [[nodiscard]] const Vec3d& axis(const Choice& choice) const {
    return choice.lobe == Lobe::highlight ? mirrored_ : normal_;
  }

  /// The way that was chosen; `direction` counts for the first two lobes only. A black weight:
  /// none.
  [[nodiscard]] Bounce bounce(const Choice& choice, const Vec3d& direction) const;

 private:
  [[nodiscard]] Bounce scattered(const Vec3d& direction) const;

  const FlatMaterial* material_;
  Vec3d normal_, mirrored_;
  Scatter way_;
  double diffuse_, highlight_, reflection_, refraction_;  ///< what each sends on
  double sum_;
};

}  // namespace boule
