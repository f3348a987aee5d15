#pragma once

#include "core/scene/background.h"

namespace boule {

/// What a ray along `direction` (any length) sees when it misses everything.
Color background_radiance(const Background& background, const Vec3f& direction);

}  // namespace boule
