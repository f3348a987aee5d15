#include "render/shading/background_radiance.h"

#include <algorithm>

#include "core/math/geometry.h"
#include "render/prepare/environment_light.h"

namespace boule {
namespace {

void copy(const Color& color, float* to) {
  to[0] = color.r;
  to[1] = color.g;
  to[2] = color.b;
}

}  // namespace

SeenBackground seen_background(const Background& background) {
  SeenBackground seen{};
  seen.kind = SeenBackground::Kind::other;
  if (const auto* constant = std::get_if<ConstantBackground>(&background)) {
    seen.kind = SeenBackground::Kind::constant;
    copy(constant->color, seen.bottom);
  } else if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    seen.kind = SeenBackground::Kind::gradient;
    copy(gradient->bottom, seen.bottom);
    copy(gradient->top, seen.top);
    const Vec3d up = normalize(vec_cast<double>(gradient->up));
    seen.up[0] = up.x;
    seen.up[1] = up.y;
    seen.up[2] = up.z;
  }
  return seen;
}

Color background_radiance(const Background& background, const Vec3f& direction) {
  if (const auto* constant = std::get_if<ConstantBackground>(&background)) return constant->color;
  if (const auto* image = std::get_if<EnvironmentBackground>(&background)) {
    return environment_radiance(*image, normalize(vec_cast<double>(direction)));
  }
  const auto& gradient = std::get<GradientBackground>(background);
  const double cosine =
      dot(normalize(vec_cast<double>(direction)), normalize(vec_cast<double>(gradient.up)));
  // Clamped, because rounding could take it out of 0..1 and a colour below 0.
  const auto share = static_cast<float>(std::clamp((1 + cosine) / 2, 0.0, 1.0));
  return gradient.bottom * (1 - share) + gradient.top * share;
}

}  // namespace boule
