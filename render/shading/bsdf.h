#pragma once

#include <algorithm>

#include "core/math/color.h"
#include "core/surface.h"
#include "render/prepare/flat_material.h"

namespace boule {

/// How a surface passes light on to the rays that continue from it. A black weight: no such ray.
struct Scatter {
  Color reflection;  ///< weight of the ray along Surface::mirrored
  Color refraction;  ///< weight of the ray along `refracted`
  Vec3d refracted;   ///< unit length; only where `refraction` is not black
};

/// True if light from `to_light` falls on the viewer's side: n.l > 0. False for NaN, where the
/// light is in the very point.
inline bool faces(const Surface& surface, const Vec3d& to_light) {
  return dot(surface.normal, to_light) > 0;
}

/// The highlight's (r.l)^shininess for r.l > 0.
double highlight_power(const FlatMaterial& material, double r_dot_l);

/// The highlight's Ks (r.l)^shininess for r.l > 0.
inline float highlight(const FlatMaterial& material, double r_dot_l) {
  return static_cast<float>(material.highlight * highlight_power(material, r_dot_l));
}

/// What light of `intensity` from the unit direction `to_light`, which the surface faces, adds if
/// nothing is in between: C Kd (n.l) I + Ks (r.l)^shininess I (lecture "Phong"; Whitted 1980),
/// the latter times n.l for FlatMaterial::cosine_highlight.
inline Color direct_light(const FlatMaterial& material, double n_dot_l, const Vec3d& to_light,
                          const Vec3d& mirrored, const Color& intensity) {
  const Color sum = material.diffuse * intensity * static_cast<float>(n_dot_l);
  if (!(material.highlight > 0)) return sum;
  // Not above 1, or a great exponent makes infinity of a rounding error.
  const double r_dot_l = std::min(dot(mirrored, to_light), 1.0);
  if (!(r_dot_l > 0)) return sum;
  const float share = material.cosine_highlight ? static_cast<float>(n_dot_l) : 1.0f;
  return sum + intensity * (highlight(material, r_dot_l) * share);
}
inline Color direct_light(const FlatMaterial& material, const Surface& surface,
                          const Vec3d& to_light, const Color& intensity) {
  return direct_light(material, dot(surface.normal, to_light), to_light, surface.mirrored,
                      intensity);
}

/// The weights of the reflected and the refracted ray (Whitted 1980), shared by Fresnel's
/// equations where the material is a dielectric. At total internal reflection all that would go
/// through joins the mirror.
Scatter scatter(const FlatMaterial& material, const Surface& surface);

}  // namespace boule
