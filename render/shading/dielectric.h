#pragma once

#include <cmath>

#include "core/math/vec.h"

namespace boule {

/// How a ray goes on when it enters another medium.
struct Refraction {
  Vec3d direction;    ///< unit length; not set if `total`
  double cosine = 0;  ///< of the angle beyond the surface; not set if `total`
  bool total = true;  ///< total internal reflection: nothing goes through
};

/// Snell's law (lecture "Refraction"), for unit vectors V and N with cosine = -N.V. eta is the
/// index of refraction on the viewer's side over that beyond the surface.
///   sin_t = eta sin_i,  direction = eta V + (eta cos_i - cos_t) N
inline Refraction refract(const Vec3d& view, const Vec3d& normal, double cosine, double eta) {
  const double sine_squared = eta * eta * (1 - cosine * cosine);
  if (sine_squared >= 1) return {};
  const double beyond = std::sqrt(1 - sine_squared);
  return {
      .direction = view * eta + normal * (eta * cosine - beyond), .cosine = beyond, .total = false};
}

/// The share of unpolarised light that a dielectric reflects, which is the mean of both
/// polarisations (Fresnel's equations; Born and Wolf, Principles of Optics, 1.5.2). `bent` is
/// what refract() gives for `cosine` and `eta`. Precondition: the reflection is not total.
inline double fresnel(double cosine, const Refraction& bent, double eta) {
  const double s = (eta * cosine - bent.cosine) / (eta * cosine + bent.cosine);
  const double p = (eta * bent.cosine - cosine) / (eta * bent.cosine + cosine);
  return 0.5 * (s * s + p * p);
}

}  // namespace boule
