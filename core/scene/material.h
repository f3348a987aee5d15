#pragma once

#include <optional>
#include <variant>

#include "core/math/color.h"
#include "core/scene/field.h"
#include "core/scene/problem.h"

namespace boule {

/// Ideal diffuse: Kd = 1.
struct Matte {
  Color color{0.8f, 0.8f, 0.8f};
};

template <>
inline constexpr auto fields<Matte> = field_list("matte",
                                                 field("color", &Matte::color, rule::not_negative));

/// Diffuse with a white highlight and, where `reflect` > 0, a mirror image.
struct Plastic {
  Color color{0.8f, 0.8f, 0.8f};
  float specular = 0.04f;
  float shininess = 50;
  float reflect = 0;
};

template <>
inline constexpr auto fields<Plastic> =
    field_list("plastic", field("color", &Plastic::color, rule::not_negative),
               field("specular", &Plastic::specular, rule::not_negative),
               field("shininess", &Plastic::shininess, rule::not_negative),
               field("reflect", &Plastic::reflect, rule::not_negative));

/// A coloured mirror.
struct Metal {
  Color color{0.8f, 0.8f, 0.8f};
};

template <>
inline constexpr auto fields<Metal> = field_list("metal",
                                                 field("color", &Metal::color, rule::not_negative));

/// Exact dielectric Fresnel; `color` tints each crossing.
struct Glass {
  Color color{1, 1, 1};
  float ior = 1.5f;
};

template <>
inline constexpr auto fields<Glass> = field_list("glass",
                                                 field("color", &Glass::color, rule::not_negative),
                                                 field("ior", &Glass::ior, rule::positive));

/// Radiates on both sides and reflects nothing.
struct Emissive {
  Color radiance{1, 1, 1};
};

template <>
inline constexpr auto fields<Emissive> =
    field_list("emissive", field("radiance", &Emissive::radiance, rule::not_negative));

/// Whitted's original model, also NFF's `f` line (Haines 1987): ambient ka, diffuse kd, highlight
/// and mirror ks, transmission T with index of refraction ior.
struct Phong {
  Color color{0.8f, 0.8f, 0.8f};
  float ka = 0;
  float kd = 1;
  float ks = 0;
  float shininess = 0;
  float transmission = 0;
  float ior = 1;
};

template <>
inline constexpr auto fields<Phong> = field_list(
    "phong", field("color", &Phong::color, rule::not_negative),
    field("ka", &Phong::ka, rule::not_negative), field("kd", &Phong::kd, rule::not_negative),
    field("ks", &Phong::ks, rule::not_negative),
    field("shininess", &Phong::shininess, rule::not_negative),
    field("transmission", &Phong::transmission, rule::not_negative),
    field("ior", &Phong::ior, rule::positive));

/// A thin film, which the camera's own rays see and pass, and no others: it neither throws shadows
/// nor shows in mirrors. Of spheres and capsules; those that overlap have one film around them.
struct Ghost {
  Color color{0.8f, 0.8f, 0.8f};
  float opacity = 0.2f;  ///< 0 .. 1, seen straight on; it grows to 1 at a rim
};

template <>
inline constexpr auto fields<Ghost> = field_list("ghost",
                                                 field("color", &Ghost::color, rule::not_negative),
                                                 field("opacity", &Ghost::opacity,
                                                       rule::from_to(0, 1)));

using Material = std::variant<Matte, Plastic, Metal, Glass, Emissive, Phong, Ghost>;

/// A material in another colour, which replaces its own. The radiance of an emissive one becomes
/// that colour times its largest component.
Material recolored(const Material& material, const Color& color);

/// The colour that recolored() replaces.
Color color_of(const Material& material);

/// The first Problem of a material: a field against its rule.
std::optional<Problem> find_problem(const Material& material);

}  // namespace boule
