#include "core/scene/material.h"

#include <algorithm>

namespace boule {

Material recolored(const Material& material, const Color& color) {
  Material other = material;
  std::visit(
      [&color](auto& kind) {
        if constexpr (requires { kind.radiance; }) {
          const Color& light = kind.radiance;
          kind.radiance = color * std::max({light.r, light.g, light.b});
        } else {
          kind.color = color;
        }
      },
      other);
  return other;
}

Color color_of(const Material& material) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.radiance; }) {
          return kind.radiance;
        } else {
          return kind.color;
        }
      },
      material);
}

}  // namespace boule
