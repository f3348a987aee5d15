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
  return {view * eta + normal * (eta * cosine - beyond), beyond, false};
}

/// The share of unpolarised light that a dielectric reflects, which is the mean of both
/// polarisations (Fresnel's equations; Born and Wolf, Principles of Optics, 1.5.2). `cosine` and
/// `eta` are as for refract(), `cosine_beyond` is Refraction::cosine.
inline double fresnel(double cosine, double cosine_beyond, double eta) {
  const double s = (eta * cosine - cosine_beyond) / (eta * cosine + cosine_beyond);
  const double p = (eta * cosine_beyond - cosine) / (eta * cosine_beyond + cosine);
  return 0.5 * (s * s + p * p);
}

}  // namespace boule
