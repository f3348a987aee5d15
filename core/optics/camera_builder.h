#pragma once

#include "core/optics/camera_view.h"
#include "core/optics/lens_optics.h"
#include "core/scene/camera.h"
#include "core/scene/distortion.h"

namespace boule {

/// The lens of a valid camera for an image of this size; empty unless it is a LensCamera. Throws
/// std::bad_alloc.
LensOptics build_lens(const Camera& camera, int width, int height);

/// A valid camera made ready for an image of `width` x `height` pixels, 1 or more. The map, if
/// there is one, must outlive the view. So must the lens of build_lens(), which a LensCamera needs:
/// without it, the camera has no rays. Preconditions, which find_problem() checks and this function
/// does not: a valid camera and a valid map. Rays of an invalid camera may be NaN, which miss; with
/// an invalid map, the kernels read memory outside of it.
CameraView build_camera(const Camera& camera, int width, int height,
                        const DistortionMap* map = nullptr, const LensOptics* lens = nullptr);

}  // namespace boule
