#pragma once

#include "core/scene/background.h"
#include "simd/abi/paths.h"

namespace boule {

/// The radiance that a ray along `direction`, of any length, sees if it misses everything.
Color background_radiance(const Background& background, const Vec3f& direction);

/// The background as kernels see it. Images are not for them.
SeenBackground seen_background(const Background& background);

}  // namespace boule
