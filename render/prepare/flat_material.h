#pragma once

#include "core/math/color.h"
#include "core/scene/material.h"

namespace boule {

/// Any material as the coefficients of one formula (Whitted 1980): what a hit sends back is
///   constant + sum over lights of diffuse (n.l) I + highlight (r.l)^shininess I
///   + mirror trace(R) + transmission trace(refracted).
/// What a material lacks is 0 here.
struct FlatMaterial {
  Color constant;                 ///< emission, and C (ka + ambient)
  Color diffuse;                  ///< C Kd
  double highlight = 0;           ///< Ks of the white highlight; 0 where shininess is 0
  double shininess = 0;           ///< Phong's exponent
  Color mirror;                   ///< weight of the reflected ray (times F where `fresnel`)
  Color transmission;             ///< weight of the refracted ray (times 1 - F where `fresnel`)
  double ior = 1;                 ///< index of refraction, inside over outside
  bool cosine_highlight = false;  ///< the highlight counts with n.l, as a reflectance does
  bool fresnel = false;           ///< a dielectric: reflection and refraction share the light
};

/// A valid material under the scene's ambient light. Glass sends on no more light than it gets: a
/// colour above 1 divides all of it, as by flatten_for_paths(), or light would grow in it. As of
/// all functions here, numbers that are not make such numbers, and nothing is thrown.
FlatMaterial flatten(const Material& material, const Color& ambient);

/// A valid material for path tracing, its constant emission alone: ambient light stands for what
/// path tracing finds. The highlight is normalised (Lafortune and Willems 1994): pi times the
/// reflectance is diffuse + highlight (r.l)^shininess, with highlight = Ks (n + 2) / 2, so that it
/// sends on Ks of the light at most. Where all that is sent on is more than arrives, for any
/// colour, everything is divided by that sum: energy is conserved.
FlatMaterial flatten_for_paths(const Material& material);

/// The share of light that the highlight of such a material sends on at most: Ks.
inline double highlight_albedo(const FlatMaterial& m) {
  return m.highlight * 2 / (m.shininess + 2);
}

/// True if light sources shine on it: otherwise no shadow ray is worth its time.
inline bool takes_direct_light(const FlatMaterial& m) {
  return !is_black(m.diffuse) || m.highlight > 0;
}

/// True if rays go on from it.
inline bool scatters(const FlatMaterial& m) {
  return !is_black(m.mirror) || !is_black(m.transmission);
}

}  // namespace boule
