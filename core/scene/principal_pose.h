#pragma once

#include <optional>

#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule {

/// How the spheres of a scene are looked at by their principal axes.
struct PrincipalPose {
  Vec3f direction;  ///< of view: along the shortest axis
  Vec3f up;         ///< the axis of middle length, so that the longest one is horizontal
};

/// By the principal axes of all points that a valid scene shows: the centres of spheres and the
/// ends of capsules. None if these are spread about equally far in all directions, or are at one
/// place. Of axes that are about equally long the picture shows the one upward that is nearer to y.
/// The largest component of an axis to the right and of an axis upward is positive, the first one
/// of equal ones. The bits depend on the points only, not on their order or on threads: sums are of
/// whole numbers. Precondition: the spheres are not packed. Throws std::bad_alloc.
std::optional<PrincipalPose> principal_pose(const Scene& scene,
                                            const ParallelFor& parallel_for = serial_for);

/// The fit of a scene without `pose`: with the direction and the up of the principal pose if it
/// asks for that one, and the scene has it.
CameraFit settled_fit(const Scene& scene, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
