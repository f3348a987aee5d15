#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boule {

/// The box around some spheres. Around none, `low` is infinity and `high` is -infinity.
struct SphereBounds {
  Vec3d low, high;
};
SphereBounds bounds_of(const std::vector<Sphere>& spheres);
/// The same around a scene's own spheres, or its packed ones.
SphereBounds bounds_of(const Scene& scene);

/// The camera that a scene without one is given: one fitted to its spheres as `scene.fit` says, for
/// pictures of `width` x `height` pixels (CameraFitter). If there are planes only, it is a pinhole
/// that looks at the first one; if there is nothing, it looks along -z. Coordinates near the end of
/// float's range can overflow here: find_problem() of the camera tells.
Camera default_camera(const Scene& scene, int width, int height,
                      const ParallelFor& parallel_for = serial_for);

/// The sentence that tells the user of it.
inline constexpr const char* camera_note = "the camera is fitted to the objects";

}  // namespace boule
