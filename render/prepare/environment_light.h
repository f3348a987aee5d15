#pragma once

#include <vector>

#include "core/math/color.h"
#include "core/math/sobol.h"
#include "core/math/vec.h"
#include "core/scene/background.h"

namespace boule {

/// The radiance of an image from a direction of unit length, bilinear between the centres of its
/// pixels. A direction with NaN gives the radiance of some pixel. Precondition of all functions
/// here: the image is valid.
Color environment_radiance(const EnvironmentBackground& image, const Vec3d& direction);

/// A direction, chosen by the light that comes from there.
struct EnvironmentSample {
  Vec3d direction;     ///< unit length
  double density = 0;  ///< per solid angle; 0 if there is no light
};

/// An environment image as a light: it chooses directions by the brightness of the image (Pharr,
/// Jakob, Humphreys, "Physically based rendering", 12.5). First it chooses a row by the light of
/// its pixels times their solid angle, then a pixel of the row by its light, then a point of the
/// pixel evenly.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  explicit EnvironmentLight(const EnvironmentBackground& image);

  /// True if the image is not black.
  [[nodiscard]] bool shines() const { return !rows_.empty() && rows_.back() > 0; }

  /// Chooses a direction by two numbers in [0, 1).
  [[nodiscard]] EnvironmentSample sample(const UnitPair& numbers) const;

  /// The density with which sample() chooses this direction, which has unit length.
  [[nodiscard]] double density(const Vec3d& direction) const;

 private:
  int width_ = 0, height_ = 0;
  float rotation_ = 0;
  std::vector<double> rows_;     ///< by row: the weights of all rows up to and including it
  std::vector<double> columns_;  ///< by pixel: the weights of its row up to and including it
};

}  // namespace boule
