#pragma once

#include "core/math/number.h"
#include "core/math/vec.h"

namespace boule {

/// The refraction of a ray that enters another medium, for doubles or for lanes of them.
template <class T>
struct RefractionOf {
  Vec3<T> direction;  ///< unit length; undefined if `total`
  T cosine = T(0.0);  ///< of the angle beyond the surface; undefined if `total`
  Mask<T> total;      ///< total internal reflection: there is no refracted ray
};
using Refraction = RefractionOf<double>;

/// Snell's law (lecture "Refraction"), for unit vectors V and N with cosine = -N.V. eta is the
/// index of refraction on the viewer's side over that beyond the surface.
///   sin_t = eta sin_i,  direction = eta V + (eta cos_i - cos_t) N
template <class T = double>
BOULE_INLINE RefractionOf<T> refract(const Vec3<T>& view, const Vec3<T>& normal, const T& cosine,
                                     const T& eta) {
  const T sine_squared = eta * eta * (T(1.0) - cosine * cosine);
  const T beyond = sqrt(T(1.0) - sine_squared);
  return {view * eta + normal * (eta * cosine - beyond), beyond, T(1.0) <= sine_squared};
}

/// The fraction of unpolarised light that a dielectric reflects, the mean of both polarisations
/// (Fresnel's equations; Born and Wolf, Principles of Optics, 1.5.2). `bent` is the result of
/// refract() for `cosine` and `eta`. Precondition: the reflection is not total.
template <class T = double>
BOULE_INLINE T fresnel(const T& cosine, const RefractionOf<T>& bent, const T& eta) {
  const T s = (eta * cosine - bent.cosine) / (eta * cosine + bent.cosine);
  const T p = (eta * bent.cosine - cosine) / (eta * bent.cosine + cosine);
  return T(0.5) * (s * s + p * p);
}

}  // namespace boule
