#pragma once

#include "core/scene/camera.h"
#include "simd/abi/camera.h"

namespace boule {

/// The plain view of a valid camera for an image of `width` x `height` pixels.
CameraView build_camera(const Camera& camera, int width, int height);

}  // namespace boule
