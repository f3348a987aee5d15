#pragma once

#include "core/optics/camera_view.h"
#include "core/optics/lens_optics.h"
#include "core/scene/camera.h"
#include "core/scene/distortion.h"

namespace boule {

/// The lens of a valid camera for such an image; empty if it is no LensCamera. Throws
/// std::bad_alloc.
LensOptics build_lens(const Camera& camera, int width, int height);

/// A valid camera made ready for an image of `width` x `height` pixels, 1 or more. The map, if
/// there is one, must outlive the view, and so must the lens, which build_lens() makes; only a
/// LensCamera needs one, and has no rays without. A valid camera and map are preconditions, which
/// find_problem() checks and this function does not: rays of an invalid camera may be NaN, which
/// miss; with an invalid map memory outside of it is read.
CameraView build_camera(const Camera& camera, int width, int height,
                        const DistortionMap* map = nullptr, const LensOptics* lens = nullptr);

}  // namespace boule
