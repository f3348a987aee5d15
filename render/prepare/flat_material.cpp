#include "render/prepare/flat_material.h"

#include <algorithm>

namespace boule {
namespace {

struct Flatten {
  Color ambient;

  FlatMaterial operator()(const Matte& m) const {
    FlatMaterial flat;
    flat.constant = m.color * ambient;
    flat.diffuse = m.color;
    return flat;
  }
  FlatMaterial operator()(const Plastic& m) const {
    FlatMaterial flat;
    flat.constant = m.color * ambient;
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
    flat.mirror = gray(1);
    flat.transmission = m.color;
    flat.ior = static_cast<double>(m.ior);
    flat.fresnel = true;
    return flat;
  }
  FlatMaterial operator()(const Emissive& m) const {
    FlatMaterial flat;
    flat.constant = m.radiance;
    return flat;
  }
  FlatMaterial operator()(const Phong& m) const {
    FlatMaterial flat;
    flat.constant = m.color * (gray(m.ka) + ambient);
    flat.diffuse = m.color * m.kd;
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

}  // namespace

namespace {

/// No rays of float directions tell a sharper highlight from a mirror; and much sharper ones are
/// lost between a double and 1.
constexpr double sharpest = 1e12;

/// The largest share of light that a material sends on, of any colour; at total reflection what
/// else goes through joins the mirror.
float largest_albedo(const FlatMaterial& m, float highlight) {
  const auto [r, g, b] = m.fresnel ? Color{std::max(m.mirror.r, m.transmission.r),
                                           std::max(m.mirror.g, m.transmission.g),
                                           std::max(m.mirror.b, m.transmission.b)}
                                   : m.mirror + m.transmission;
  return std::max({m.diffuse.r + r, m.diffuse.g + g, m.diffuse.b + b}) + highlight;
}

}  // namespace

FlatMaterial flatten_for_paths(const Material& material) {
  FlatMaterial flat = flatten(material, Color{});
  if (!std::holds_alternative<Emissive>(material)) flat.constant = {};
  flat.shininess = std::min(flat.shininess, sharpest);
  const float largest = largest_albedo(flat, static_cast<float>(flat.highlight));
  flat.highlight *= (flat.shininess + 2) / 2;
  flat.cosine_highlight = true;
  if (!(largest > 1)) return flat;
  flat.diffuse = flat.diffuse * (1 / largest);
  flat.highlight /= static_cast<double>(largest);
  flat.mirror = flat.mirror * (1 / largest);
  flat.transmission = flat.transmission * (1 / largest);
  return flat;
}

FlatMaterial flatten(const Material& material, const Color& ambient) {
  return std::visit(Flatten{ambient}, material);
}

}  // namespace boule
