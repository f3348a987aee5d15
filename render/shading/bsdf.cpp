#include "render/shading/bsdf.h"

#include <algorithm>

#include "core/math/elementary.h"
#include "render/shading/dielectric.h"

namespace boule {

Color direct_light(const FlatMaterial& material, const Surface& surface, const Vec3d& to_light,
                   const Color& intensity) {
  const double n_dot_l = dot(surface.normal, to_light);
  if (!(n_dot_l > 0)) return {};  // NaN, a light in the very point, as well
  Color sum = material.diffuse * intensity * static_cast<float>(n_dot_l);
  if (material.highlight > 0) {
    // Not above 1, or a great exponent makes infinity of a rounding error.
    const double r_dot_l = std::min(dot(surface.mirrored, to_light), 1.0);
    if (r_dot_l > 0) {
      const double glare = material.highlight * elementary::pow(r_dot_l, material.shininess);
      sum = sum + intensity * static_cast<float>(glare);
    }
  }
  return sum;
}

Scatter scatter(const FlatMaterial& material, const Surface& surface) {
  if (is_black(material.transmission) && !material.fresnel) return {material.mirror, {}, {}};
  const double eta = surface.inner ? material.ior : 1 / material.ior;
  const Refraction bent = refract(surface.view, surface.normal, surface.cosine, eta);
  if (material.fresnel) {
    if (bent.total) return {material.mirror, {}, {}};
    const double reflected = fresnel(surface.cosine, bent.cosine, eta);
    return {material.mirror * static_cast<float>(reflected),
            material.transmission * static_cast<float>(1 - reflected), bent.direction};
  }
  if (bent.total) return {material.mirror + material.transmission, {}, {}};
  return {material.mirror, material.transmission, bent.direction};
}

}  // namespace boule
