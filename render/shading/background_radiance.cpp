#include "render/shading/background_radiance.h"

#include <algorithm>

#include "core/math/geometry.h"
#include "render/prepare/environment_light.h"

namespace boule {

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
