#pragma once

#include <vector>

#include "core/scene/camera.h"
#include "core/scene/lens_optics.h"
#include "simd/abi/camera.h"

namespace boule {

/// What of a lens the kernels see, kept together.
struct LensStack {
  std::vector<LensElementView> elements;
  std::vector<PupilBoxView> pupil;
  LensView view{};  ///< of the two above, wherever this is moved to

  LensStack() = default;
  explicit LensStack(const LensOptics& optics);
};

/// The lens of a valid camera for such an image; empty if it is no LensCamera.
LensStack build_lens(const Camera& camera, int width, int height);

/// The plain view of a valid camera for an image of `width` x `height` pixels. The map, if there is
/// one, must outlive the view, and so must the lens, which build_lens() makes; only a LensCamera
/// needs one. Neither checks the camera: find_problem() does. Both throw std::bad_alloc.
CameraView build_camera(const Camera& camera, int width, int height,
                        const DistortionMap* map = nullptr, const LensStack* lens = nullptr);

}  // namespace boule
