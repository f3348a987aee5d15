#pragma once

#include "core/math/color.h"
#include "core/optics/reflectance.h"
#include "core/surface.h"
#include "render/prepare/flat_material.h"

namespace boule {

/// The formulas of core/optics/reflectance.h for one surface.

/// The weights of the rays that continue from a surface. There is no ray if the weight is black.
struct Scatter {
  Color reflection;  ///< weight of the ray along Surface::mirrored
  Color refraction;  ///< weight of the ray along `refracted`
  Vec3d refracted;   ///< unit length; undefined if `refraction` is black
};

inline Vec3f vector_of(const Color& c) { return {c.r, c.g, c.b}; }
inline Color color_of(const Vec3f& v) { return {v.x, v.y, v.z}; }

inline CoefficientsOf<double> coefficients(const FlatMaterial& m) {
  return {vector_of(m.diffuse),
          vector_of(m.mirror),
          vector_of(m.transmission),
          m.highlight,
          m.shininess,
          m.ior,
          m.fresnel};
}

/// The weights of the reflected and the refracted ray.
inline Scatter scatter(const FlatMaterial& material, const Surface& surface) {
  const IncidenceOf<double> met{surface.normal, surface.view, surface.mirrored, surface.cosine,
                                surface.inner};
  const ScatterOf<double> weights = scatter(coefficients(material), met);
  return {color_of(weights.reflection), color_of(weights.refraction), weights.refracted};
}

}  // namespace boule
