#include "render/prepare/flat_material.h"

#include <algorithm>
#include <limits>

namespace boule {
namespace {

constexpr float largest_float = std::numeric_limits<float>::max();

/// A colour in which infinity became the largest float.
Color held(const Color& c) {
  return {std::min(c.r, largest_float), std::min(c.g, largest_float), std::min(c.b, largest_float)};
}

struct Flatten {
  Color ambient;

  FlatMaterial operator()(const Matte& m) const {
    FlatMaterial flat;
    flat.constant = held(m.color * ambient);
    flat.diffuse = m.color;
    return flat;
  }
  FlatMaterial operator()(const Plastic& m) const {
    FlatMaterial flat;
    flat.constant = held(m.color * ambient);
    flat.diffuse = m.color;
    set_highlight(flat, m.specular, m.shininess);
    flat.mirror = gray(m.reflect);
    return flat;
  }
  FlatMaterial operator()(const Metal& m) const {
    FlatMaterial flat;
    flat.mirror = m.color;
    return flat;
  }
  FlatMaterial operator()(const Glass& m) const {
    FlatMaterial flat;
    const float largest = std::max({m.color.r, m.color.g, m.color.b, 1.0f});
    flat.mirror = gray(1) * (1 / largest);
    flat.transmission = m.color * (1 / largest);
    flat.ior = static_cast<double>(m.ior);
    flat.fresnel = true;
    return flat;
  }
  FlatMaterial operator()(const Emissive& m) const {
    FlatMaterial flat;
    flat.constant = m.radiance;
    return flat;
  }
  /// Of the ones that rays of no kernel meet.
  FlatMaterial operator()(const Ghost& m) const { return (*this)(Matte{m.color}); }
  FlatMaterial operator()(const Phong& m) const {
    FlatMaterial flat;
    flat.constant = held(m.color * held(gray(m.ka) + ambient));
    flat.diffuse = held(m.color * m.kd);
    set_highlight(flat, m.ks, m.shininess);
    flat.mirror = gray(m.ks);
    flat.transmission = gray(m.transmission);
    flat.ior = static_cast<double>(m.ior);
    return flat;
  }

 private:
  static void set_highlight(FlatMaterial& flat, float specular, float shininess) {
    if (!(shininess > 0)) return;
    flat.highlight = static_cast<double>(specular);
    flat.shininess = static_cast<double>(shininess);
  }
};

/// The largest exponent of a highlight. With float directions nobody can tell a sharper one from a
/// mirror, and the cosines of much sharper ones round to 1.
constexpr double sharpest = 1e12;

/// The largest share of light that a material sends on, over the components. Fresnel's equations
/// divide the light between mirror and transmission; without them both count in full.
float largest_albedo(const FlatMaterial& m, float highlight) {
  const auto [r, g, b] = m.fresnel ? Color{std::max(m.mirror.r, m.transmission.r),
                                           std::max(m.mirror.g, m.transmission.g),
                                           std::max(m.mirror.b, m.transmission.b)}
                                   : m.mirror + m.transmission;
  return std::max({m.diffuse.r + r, m.diffuse.g + g, m.diffuse.b + b}) + highlight;
}

void scale(FlatMaterial& m, float factor) {
  m.diffuse = m.diffuse * factor;
  m.mirror = m.mirror * factor;
  m.transmission = m.transmission * factor;
}

}  // namespace

FlatMaterial flatten_for_paths(const Material& material) {
  FlatMaterial flat = flatten(material, Color{});
  if (!std::holds_alternative<Emissive>(material)) flat.constant = {};
  flat.shininess = std::min(flat.shininess, sharpest);
  float largest = largest_albedo(flat, static_cast<float>(flat.highlight));
  if (largest > largest_float) {  // a sum of four floats: an eighth of it is finite
    scale(flat, 0.125F);
    flat.highlight *= 0.125;
    largest = largest_albedo(flat, static_cast<float>(flat.highlight));
  }
  flat.highlight *= (flat.shininess + 2) / 2;
  flat.cosine_highlight = true;
  if (!(largest > 1)) return flat;
  scale(flat, 1 / largest);
  flat.highlight /= static_cast<double>(largest);
  return flat;
}

FlatMaterial flatten(const Material& material, const Color& ambient) {
  return std::visit(Flatten{ambient}, material);
}

}  // namespace boule
