#pragma once

#include "core/math/color.h"
#include "core/scene/scene.h"
#include "simd/abi/paths.h"

namespace boule {

/// A valid material under the scene's ambient light. Glass conserves energy: if a component of its
/// colour is above 1, all its weights are divided by that component.
FlatMaterial flatten(const Material& material, const Color& ambient);

/// A valid material for path tracing. Its constant is emission alone, because ambient light stands
/// for the light that path tracing finds. The highlight is normalised (Lafortune and Willems 1994):
/// pi times the reflectance is diffuse + highlight (r.l)^n with highlight = Ks (n + 2) / 2, so the
/// highlight sends on at most Ks of the light. If a material would send on more light than arrives,
/// in any component, all its weights are divided by that sum, which conserves energy.
FlatMaterial flatten_for_paths(const Material& material);

/// A valid material for the method.
inline FlatMaterial flatten(const Material& material, const Color& ambient, Method method) {
  return method == Method::path ? flatten_for_paths(material) : flatten(material, ambient);
}

/// The largest fraction of light that the highlight of such a material sends on: Ks.
inline double highlight_albedo(const FlatMaterial& m) {
  return m.highlight * 2 / (m.shininess + 2);
}

/// True if a light's direct light counts for the material. Otherwise it needs no shadow rays.
inline bool takes_direct_light(const FlatMaterial& m) {
  return !is_black(m.diffuse) || m.highlight > 0;
}

/// True if rays are reflected or refracted by the material.
inline bool scatters(const FlatMaterial& m) {
  return !is_black(m.mirror) || !is_black(m.transmission);
}

}  // namespace boule
