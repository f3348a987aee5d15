#pragma once

#include <algorithm>

#include "core/math/color.h"
#include "core/surface.h"
#include "render/prepare/flat_material.h"

namespace boule {

/// How much the rays that continue from a surface count. There is no ray where the weight is black.
struct Scatter {
  Color reflection;  ///< weight of the ray along Surface::mirrored
  Color refraction;  ///< weight of the ray along `refracted`
  Vec3d refracted;   ///< unit length; not set if `refraction` is black
};

/// (r.l)^shininess, the shape of the highlight. Precondition: r.l > 0.
double highlight_power(const FlatMaterial& material, double r_dot_l);

/// Ks (r.l)^shininess, the highlight itself. Precondition: r.l > 0.
inline float highlight(const FlatMaterial& material, double r_dot_l) {
  return static_cast<float>(material.highlight * highlight_power(material, r_dot_l));
}

/// The light that a surface sends to the viewer when light of `intensity` arrives from the unit
/// direction `to_light`: C Kd (n.l) I + Ks (r.l)^shininess I (lecture "Phong"; Whitted 1980). The
/// highlight is multiplied by n.l if FlatMaterial::cosine_highlight. Precondition: n.l > 0.
inline Color direct_light(const FlatMaterial& material, double n_dot_l, const Vec3d& to_light,
                          const Vec3d& mirrored, const Color& intensity) {
  const Color sum = material.diffuse * intensity * static_cast<float>(n_dot_l);
  if (!(material.highlight > 0)) return sum;
  // At most 1, or a large exponent makes infinity of a rounding error.
  const double r_dot_l = std::min(dot(mirrored, to_light), 1.0);
  if (!(r_dot_l > 0)) return sum;
  const float share = material.cosine_highlight ? static_cast<float>(n_dot_l) : 1.0f;
  return sum + intensity * (highlight(material, r_dot_l) * share);
}

/// The weights of the reflected and the refracted ray (Whitted 1980). For a dielectric, Fresnel's
/// equations divide the light between them. At total internal reflection the light that would go
/// through is reflected as well.
Scatter scatter(const FlatMaterial& material, const Surface& surface);

}  // namespace boule
