#pragma once

#include "core/math/color.h"
#include "core/scene/material.h"

namespace boule {

/// Any material as the coefficients of one formula (Whitted 1980): what a hit sends back is
///   constant + sum over lights of diffuse (n.l) I + highlight (r.l)^shininess I
///   + mirror trace(R) + transmission trace(refracted).
/// What a material lacks is 0 here.
struct FlatMaterial {
  Color constant;        ///< emission, and C (ka + ambient)
  Color diffuse;         ///< C Kd
  double highlight = 0;  ///< Ks of the white highlight; 0 where shininess is 0
  double shininess = 0;  ///< Phong's exponent
  Color mirror;          ///< weight of the reflected ray (times F where `fresnel`)
  Color transmission;    ///< weight of the refracted ray (times 1 - F where `fresnel`)
  double ior = 1;        ///< index of refraction, inside over outside
  bool fresnel = false;  ///< a dielectric: reflection and refraction share the light
};

/// A valid material under the scene's ambient light.
FlatMaterial flatten(const Material& material, const Color& ambient);

/// True if light sources shine on it: otherwise no shadow ray is worth its time.
inline bool takes_direct_light(const FlatMaterial& m) {
  return !is_black(m.diffuse) || m.highlight > 0;
}

/// True if rays go on from it.
inline bool scatters(const FlatMaterial& m) {
  return !is_black(m.mirror) || !is_black(m.transmission);
}

}  // namespace boule
