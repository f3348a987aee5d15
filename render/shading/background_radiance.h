#pragma once

#include <optional>

#include "core/scene/background.h"
#include "simd/abi/paths.h"

namespace boule {

/// The background's radiance for a ray along `direction`, of any length, that misses everything.
Color background_radiance(const Background& background, const Vec3f& direction);

/// The colour that a camera ray along `direction` sees where it misses everything: the backdrop,
/// if there is one.
inline Color seen_behind(const Background& background, const std::optional<Color>& backdrop,
                         const Vec3f& direction) {
  return backdrop ? *backdrop : background_radiance(background, direction);
}

/// The background for the kernels, which leave out images.
SeenBackground seen_background(const Background& background);

}  // namespace boule
