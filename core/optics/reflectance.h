#pragma once

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/math/interval.h"
#include "core/math/number.h"
#include "core/math/sobol.h"
#include "core/math/warp.h"
#include "core/optics/dielectric.h"

namespace boule {

/// The reflection and refraction of light at surfaces, as formulas for doubles and for lanes of
/// them. Coefficients, weights and colours are floats, as in FlatMaterial; directions, cosines and
/// densities are doubles.

template <class T>
using ColorOf = Vec3<Single<T>>;

template <class T>
BOULE_INLINE Mask<Single<T>> is_black_in(const ColorOf<T>& c) {
  const Single<T> zero(0.0F);
  return (c.x == zero) & (c.y == zero) & (c.z == zero);
}
/// (r + g + b) / 3
template <class T>
BOULE_INLINE T mean_of(const ColorOf<T>& c) {
  return (widen(c.x) + widen(c.y) + widen(c.z)) * T(1.0 / 3);
}
template <class F>
BOULE_INLINE Vec3<F> product(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// The coefficients of a material: those of FlatMaterial.
template <class T>
struct CoefficientsOf {
  ColorOf<T> diffuse, mirror, transmission;
  T highlight, shininess, ior;
  Mask<T> fresnel;
  int common_exponent = 0;  ///< as_whole_exponent() of the shininess of all lanes; 0: it varies
};

/// A ray that arrived at a surface: meanings as in Surface.
template <class T>
struct IncidenceOf {
  Vec3<T> normal, view, mirrored;
  T cosine;
  Mask<T> inner;
};

/// Exponents up to this are computed by squaring if they are whole.
inline constexpr double most_squared = 1024;

/// An exponent that is computed by squaring; 0: another one.
BOULE_INLINE int as_whole_exponent(double exponent) {
  if (!(1 <= exponent && exponent <= most_squared)) return 0;
  const int whole = static_cast<int>(exponent);
  return exponent == whole ? whole : 0;
}

/// base^exponent for an exponent of at least 1.
template <class T>
BOULE_INLINE T whole_power(const T& base, int exponent) {
  T result(1.0), square = base;
  for (; exponent > 1; exponent /= 2) {
    if (exponent % 2 == 1) result = result * square;
    square = square * square;
  }
  return result * square;
}

/// base^exponent for 0 < base <= 1 and exponent > 0. Most materials have whole exponents, which are
/// computed by squaring: that takes a fraction of the time, and its error is far below a float's.
template <class T>
BOULE_INLINE T cosine_power(const T& base, const T& exponent) {
  const T largest(most_squared), held = select(largest < exponent, largest, exponent);
  const T nearest = elementary::detail::round_to_integer(held);
  const T whole = select(held < nearest, nearest - T(1.0), nearest);
  const Mask<T> broken = (whole < exponent) | (exponent < whole);
  T result(1.0), square = base, left = select(broken, T(0.0), whole);
  while (any(T(0.0) < left)) {
    const T half = elementary::detail::round_to_integer(left * T(0.5) - T(0.25));  // rounded down
    result = select(half + half < left, result * square, result);
    square = square * square;
    left = half;
  }
  if (any(broken)) result = select(broken, elementary::pow_for_float(base, exponent), result);
  return result;
}

/// (r.l)^n of the highlight; 0 for materials without one, and for light from the other side.
template <class T>
BOULE_INLINE T highlight_power(const CoefficientsOf<T>& material, const Vec3<T>& mirrored,
                               const Vec3<T>& to_light) {
  if (!any(T(0.0) < material.highlight)) return T(0.0);
  const T along = dot(mirrored, to_light);
  // At most 1, because a large exponent would turn a rounding error into infinity.
  const T r_dot_l = select(T(1.0) < along, T(1.0), along);
  const Mask<T> seen = (T(0.0) < material.highlight) & (T(0.0) < r_dot_l);
  if (!any(seen)) return T(0.0);
  const T base = select(seen, r_dot_l, T(1.0));
  const T power = material.common_exponent > 0 ? whole_power(base, material.common_exponent)
                                               : cosine_power(base, material.shininess);
  return select(seen, power, T(0.0));
}

/// The light that a surface sends to the viewer for light of `intensity` from a direction: C Kd
/// (n.l) I + Ks (r.l)^n I (lecture "Phong"; Whitted 1980). `power`: highlight_power(). With `share`
/// the highlight is multiplied by it: n.l or 1. Precondition: n.l > 0.
template <class T>
BOULE_INLINE ColorOf<T> reflected_light(const CoefficientsOf<T>& material, const T& n_dot_l,
                                        const T& power, const Single<T>& share,
                                        const ColorOf<T>& intensity) {
  ColorOf<T> sum = product(material.diffuse, intensity) * narrow(n_dot_l);
  const Mask<T> seen = T(0.0) < power;
  if (!any(seen)) return sum;
  const Single<T> highlight = narrow(material.highlight * power) * share;
  return select(narrow(seen), sum + intensity * highlight, sum);
}

/// The weights of the rays that continue from a surface. There is no ray if the weight is black.
template <class T>
struct ScatterOf {
  ColorOf<T> reflection;  ///< weight of the ray along the mirrored direction
  ColorOf<T> refraction;  ///< weight of the ray along `refracted`
  Vec3<T> refracted;      ///< unit length; undefined if `refraction` is black
};

/// The weights of the reflected and the refracted ray (Whitted 1980). For a dielectric, Fresnel's
/// equations divide the light between them. At total internal reflection, the transmitted light is
/// reflected as well.
template <class T>
BOULE_INLINE ScatterOf<T> scatter(const CoefficientsOf<T>& material, const IncidenceOf<T>& met) {
  using F = Single<T>;
  const ColorOf<T> none{F(0.0F), F(0.0F), F(0.0F)};
  const Mask<F> fresnels = narrow(material.fresnel), black = is_black_in<T>(material.transmission);
  const Mask<F> straight = black & complement(fresnels);
  if (!any(complement(straight))) return {material.mirror, none, met.view};
  const T eta = select(met.inner, material.ior, T(1.0) / material.ior);
  const RefractionOf<T> bent = refract(met.view, met.normal, met.cosine, eta);
  const T reflected = fresnel(met.cosine, bent, eta);
  const Mask<F> total = narrow(bent.total);
  const ColorOf<T> both = material.mirror + material.transmission;
  const ColorOf<T> at_total = select(fresnels, material.mirror, both);
  const ColorOf<T> divided = select(fresnels, material.mirror * narrow(reflected), material.mirror);
  const ColorOf<T> through =
      select(fresnels, material.transmission * narrow(T(1.0) - reflected), material.transmission);
  return {select(straight, material.mirror, select(total, at_total, divided)),
          select(total, none, through), bent.direction};
}

}  // namespace boule
