#pragma once

#include "core/math/color.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
#include "core/surface.h"
#include "render/prepare/flat_material.h"
#include "render/shading/bsdf.h"

namespace boule::test {

/// The formulas of core/optics/lobes.h once more, for one surface, with branches, and as they were
/// before there were kernels of them: what judges the kernels.

/// A random direction in which a path goes on from a surface.
struct Bounce {
  Vec3d direction;     ///< unit length
  Side side;           ///< of the surface, on which the path leaves
  Color weight;        ///< of light from there: reflectance times cosine over density
  double density = 0;  ///< per solid angle; 0 for the one direction of a mirror or of refraction
};

/// The weights of the reflected and the refracted ray.
Scatter scatter_twin(const FlatMaterial& material, const Surface& surface);

/// Chooses directions by a surface's lobes: the diffuse one, the highlight around the mirrored view
/// direction, the reflected direction and the refracted one. The probability of a lobe is its share
/// of the light that the surface sends on. The material is one of flatten_for_paths(), and must
/// outlive the sampler.
class LobeSampler {
 public:
  enum class Lobe { none, diffuse, highlight, reflection, refraction };
  /// A lobe and, of the diffuse lobe and the highlight, a direction in it.
  struct Choice {
    Lobe lobe = Lobe::none;
    Angle from{};      ///< the angle between axis() and the direction
    double turns = 0;  ///< the direction's angle around axis(), in turns
  };

  LobeSampler(const FlatMaterial& material, const Surface& surface);

  /// True if the surface sends no light on.
  [[nodiscard]] bool black() const { return !(sum_ > 0); }

  /// The reflectance of the diffuse lobe and the highlight for light from `to_light`, times
  /// `cosine`, which is n.l, times pi. Precondition: cosine > 0.
  [[nodiscard]] Color reflected(double cosine, const Vec3d& to_light) const;

  /// The density with which the diffuse lobe and the highlight choose this direction; `cosine` is
  /// n.l.
  [[nodiscard]] double density(double cosine, const Vec3d& to_light) const;

  /// Chooses a lobe and a direction in it by two numbers in [0, 1).
  [[nodiscard]] Choice choose(UnitPair numbers) const;

  /// The axis of the chosen lobe: its direction is direction_about(axis(choice), from, turns).
  [[nodiscard]] const Vec3d& axis(const Choice& choice) const {
    return choice.lobe == Lobe::highlight ? mirrored_ : normal_;
  }

  /// How the path goes on after a choice. `direction` is used for the diffuse lobe and the
  /// highlight only. The path ends if the weight is black.
  [[nodiscard]] Bounce bounce(const Choice& choice, const Vec3d& direction) const;

 private:
  [[nodiscard]] Bounce scattered(const Vec3d& direction) const;

  const FlatMaterial* material_;
  Vec3d normal_, mirrored_;
  Scatter weights_;
  double diffuse_, highlight_, reflection_, refraction_;  ///< the light that each sends on
  double sum_;
};

}  // namespace boule::test
