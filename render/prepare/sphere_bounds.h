#pragma once

#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule {

/// The box around the spheres and capsules of a scene, those of its instances among them. Around
/// none, `low` is infinity and `high` is -infinity.
struct SphereBounds {
  Vec3d low, high;
};
SphereBounds bounds_of(const Scene& scene);
/// The same without spheres that lie far from all others (without_outliers()).
SphereBounds bounds_without_outliers(const Scene& scene);

}  // namespace boule
