#pragma once

#include "core/scene/background.h"
#include "simd/abi/paths.h"

namespace boule {

/// The background's radiance for a ray along `direction`, of any length, that misses everything.
Color background_radiance(const Background& background, const Vec3f& direction);

/// The background for the kernels, which leave out images.
SeenBackground seen_background(const Background& background);

}  // namespace boule
