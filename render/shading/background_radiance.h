#pragma once

#include "core/scene/background.h"

namespace boule {

/// The radiance that a ray along `direction`, of any length, sees if it misses everything.
Color background_radiance(const Background& background, const Vec3f& direction);

}  // namespace boule
