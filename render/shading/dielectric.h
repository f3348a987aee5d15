#pragma once

#include <cmath>

#include "core/math/vec.h"

namespace boule {

/// A ray bent where it enters another medium.
struct Refraction {
  Vec3d direction;    ///< unit length; only where not `total`
  double cosine = 0;  ///< of the angle beyond the surface
  bool total = true;  ///< total internal reflection: nothing goes through
};

/// Snell's law (lecture "Refraction") for unit V and N, cosine = -N.V, and eta = the index of
/// refraction on the viewer's side over the one beyond:
///   sin_t = eta sin_i,  direction = eta V + (eta cos_i - cos_t) N.
inline Refraction refract(const Vec3d& view, const Vec3d& normal, double cosine, double eta) {
  const double sine_squared = eta * eta * (1 - cosine * cosine);
  if (sine_squared >= 1) return {};
  const double beyond = std::sqrt(1 - sine_squared);
  return {view * eta + normal * (eta * cosine - beyond), beyond, false};
}

/// The share of unpolarised light that a dielectric reflects (Fresnel's equations; Born and Wolf,
/// Principles of Optics, 1.5.2): the mean of both polarisations. Arguments as in refract().
inline double fresnel(double cosine, double cosine_beyond, double eta) {
  const double s = (eta * cosine - cosine_beyond) / (eta * cosine + cosine_beyond);
  const double p = (eta * cosine_beyond - cosine) / (eta * cosine_beyond + cosine);
  return 0.5 * (s * s + p * p);
}

}  // namespace boule
