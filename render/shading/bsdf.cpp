#include "render/shading/bsdf.h"

#include <algorithm>

#include "core/math/elementary.h"
#include "render/shading/dielectric.h"

namespace boule {
namespace {

/// base^exponent for 0 < base <= 1 and exponent > 0. Most materials have whole exponents, which are
/// computed by squaring: that takes a fraction of the time, and its error is far below a float's.
double power(double base, double exponent) {
  constexpr double largest = 1024;
  const auto whole = static_cast<int>(std::min(exponent, largest));
  if (exponent != whole) return elementary::pow_for_float(base, exponent);
  double result = 1;
  for (int n = whole; n > 0; n /= 2) {
    if (n % 2 == 1) result *= base;
    base *= base;
  }
  return result;
}

}  // namespace

double highlight_power(const FlatMaterial& material, double r_dot_l) {
  return power(r_dot_l, material.shininess);
}

Scatter scatter(const FlatMaterial& material, const Surface& surface) {
  if (is_black(material.transmission) && !material.fresnel) return {material.mirror, {}, {}};
  const double eta = surface.inner ? material.ior : 1 / material.ior;
  const Refraction bent = refract(surface.view, surface.normal, surface.cosine, eta);
  if (material.fresnel) {
    if (bent.total) return {material.mirror, {}, {}};
    const double reflected = fresnel(surface.cosine, bent, eta);
    return {material.mirror * static_cast<float>(reflected),
            material.transmission * static_cast<float>(1 - reflected), bent.direction};
  }
  if (bent.total) return {material.mirror + material.transmission, {}, {}};
  return {material.mirror, material.transmission, bent.direction};
}

}  // namespace boule
