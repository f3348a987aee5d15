#pragma once

#include <vector>

#include "core/math/color.h"
#include "core/math/sobol.h"
#include "core/math/vec.h"
#include "core/scene/background.h"

namespace boule {

/// The image's radiance from a direction of unit length, bilinear between its pixels' centres; from
/// one with NaN, of any of its pixels. The image is a valid one: precondition of all here.
Color environment_radiance(const EnvironmentBackground& image, const Vec3d& direction);

/// A direction that was chosen because of the light from there.
struct EnvironmentSample {
  Vec3d direction;     ///< unit length
  double density = 0;  ///< per solid angle; 0: there is no light
};

/// Directions of an environment image, chosen as often as it is bright there (Pharr, Jakob,
/// Humphreys, "Physically based rendering", 12.5): a row by the light of its pixels and their solid
/// angle, a pixel of it by the light of its area, a point of the pixel evenly.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  /// Throws std::bad_alloc.
  explicit EnvironmentLight(const EnvironmentBackground& image);

  /// True if there is any light.
  [[nodiscard]] bool shines() const { return !rows_.empty() && rows_.back() > 0; }

  /// A direction by two numbers in [0, 1).
  [[nodiscard]] EnvironmentSample sample(const UnitPair& numbers) const;

  /// The density of this direction, of unit length, in sample().
  [[nodiscard]] double density(const Vec3d& direction) const;

 private:
  int width_ = 0, height_ = 0;
  float rotation_ = 0;
  std::vector<double> rows_;     ///< sums of weights, up to and with each row
  std::vector<double> columns_;  ///< by row: sums up to and with each of its pixels
};

}  // namespace boule
