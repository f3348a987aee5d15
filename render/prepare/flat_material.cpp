#include "render/prepare/flat_material.h"

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

FlatMaterial flatten(const Material& material, const Color& ambient) {
  return std::visit(Flatten{ambient}, material);
}

}  // namespace boule
