#pragma once

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "render/prepare/camera_fitter.h"
#include "render/prepare/default_view.h"
#include "render/prepare/sphere_bounds.h"

namespace boule {

/// The camera that a scene without one is given: one fitted to its spheres and capsules as
/// `scene.fit` says, for pictures of `width` x `height` pixels (CameraFitter). If there are planes
/// only, it is a pinhole that looks at the first one; if there is nothing, it looks along -z.
/// Spheres far from all others are left out where they make the rest too small to be seen
/// (is_better_without()). Coordinates near the end of float's range can overflow here:
/// find_problem() of the camera tells.
struct DefaultCamera {
  Camera camera;
  bool leaves_out = false;  ///< some spheres
};
DefaultCamera choose_camera(const Scene& scene, int width, int height,
                            const ParallelFor& parallel_for = serial_for);
inline Camera default_camera(const Scene& scene, int width, int height,
                             const ParallelFor& parallel_for = serial_for) {
  return choose_camera(scene, width, height, parallel_for).camera;
}

/// The two steps to the fitted one, for several scenes that one camera shows: the first scene's
/// view, and then all that the camera depends on of each scene. Precondition: it is not packed.
View view_of(const Scene& scene, const ParallelFor& parallel_for = serial_for);
void add_spheres(const Scene& scene, CameraFitter& fitter,
                 const ParallelFor& parallel_for = serial_for);

/// The sentence that tells the user of it, and what is added to it.
inline constexpr const char* camera_note = "the camera is fitted to the objects";
inline constexpr const char* left_out_note =
    ", but not to spheres far from all others, which would make most smaller than a pixel";

}  // namespace boule
