#pragma once

#include <optional>
#include <variant>

#include "core/math/color.h"
#include "core/scene/primitive.h"

namespace boule {

/// Ideal diffuse: Kd = 1.
struct Matte {
  Color color{0.8f, 0.8f, 0.8f};
};

/// Diffuse with a white highlight and, where `reflect` > 0, a mirror image.
struct Plastic {
  Color color{0.8f, 0.8f, 0.8f};
  float specular = 0.04f;
  float shininess = 50;
  float reflect = 0;
};

/// A coloured mirror.
struct Metal {
  Color color{0.8f, 0.8f, 0.8f};
};

/// Exact dielectric Fresnel; `color` tints each crossing.
struct Glass {
  Color color{1, 1, 1};
  float ior = 1.5f;
};

/// Radiates on both sides, reflects nothing.
struct Emissive {
  Color radiance{1, 1, 1};
};

/// Whitted's model as it stands, also NFF's `f` line (Haines 1987): ambient ka, diffuse kd,
/// highlight and mirror ks, transmission T with index of refraction ior.
struct Phong {
  Color color{0.8f, 0.8f, 0.8f};
  float ka = 0;
  float kd = 1;
  float ks = 0;
  float shininess = 0;
  float transmission = 0;
  float ior = 1;
};

using Material = std::variant<Matte, Plastic, Metal, Glass, Emissive, Phong>;

/// The first Problem of a material: ior <= 0, a negative coefficient, anything not finite.
std::optional<Problem> find_problem(const Material& material);

}  // namespace boule
