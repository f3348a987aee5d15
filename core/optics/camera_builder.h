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
/// LensCamera needs one, and has no rays without. Preconditions, which find_problem() checks and
/// nobody here: of an invalid camera the rays may be NaN, which miss; with an invalid map they are
/// made of foreign memory.
CameraView build_camera(const Camera& camera, int width, int height,
                        const DistortionMap* map = nullptr, const LensOptics* lens = nullptr);

}  // namespace boule
