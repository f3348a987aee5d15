#pragma once

#include <array>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/camera_fit.h"
#include "core/scene/instances.h"
#include "core/scene/primitive.h"

namespace boule {

/// From where a scene is looked at: unit vectors.
struct View {
  Vec3d direction;  ///< in which the camera looks
  Vec3d up;         ///< upward in the picture; not along `direction`
};

/// The direction and the up of `fit`, or where it lacks them those that show the most of the
/// spheres: across their longest side, slightly from above, and from higher up where they lie flat;
/// face on if they are a sheet, one sphere thick, then with what is behind upward if it is seen
/// from above. Without an up, y is up, or the axis along which the first plane's normal lies.
/// Precondition: fit's vectors are finite and not zero. A fit whose up lies along its direction
/// gives such a View.
View default_view(const CameraFit& fit, const SphereRuns& spheres, const std::vector<Plane>& planes,
                  const ParallelFor& parallel_for = serial_for);
View default_view(const CameraFit& fit, const std::vector<Sphere>& spheres,
                  const std::vector<Plane>& planes, const ParallelFor& parallel_for = serial_for);

/// The directions across which default_view() measures the spheres: it depends on them by how far
/// they and their centres reach along these, both ways.
std::array<Vec3d, 3> measured_axes(const CameraFit& fit, const std::vector<Plane>& planes);

}  // namespace boule
