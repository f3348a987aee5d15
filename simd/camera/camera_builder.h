#pragma once

#include <utility>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/lens_optics.h"
#include "simd/abi/camera.h"

namespace boule {

/// What of a lens the kernels see, kept together. Throws std::bad_alloc.
struct LensStack {
  std::vector<LensElementView> elements;
  std::vector<PupilRingView> pupil;
  LensView view{};  ///< of the two above, wherever this is moved to; empty of one moved away

  LensStack() = default;
  explicit LensStack(const LensOptics& optics);
  LensStack(LensStack&& other) noexcept
      : elements(std::move(other.elements)),
        pupil(std::move(other.pupil)),
        view(std::exchange(other.view, {})) {}
  LensStack& operator=(LensStack&& other) noexcept {
    LensStack taken(std::move(other));
    elements.swap(taken.elements);
    pupil.swap(taken.pupil);
    std::swap(view, taken.view);
    return *this;
  }
};

/// The lens of a valid camera for such an image; empty if it is no LensCamera. Throws
/// std::bad_alloc.
LensStack build_lens(const Camera& camera, int width, int height);

/// The plain view of a valid camera for an image of `width` x `height` pixels, 1 or more. The map,
/// if there is one, must outlive the view, and so must the lens, which build_lens() makes; only a
/// LensCamera needs one, and has no rays without. Preconditions, which find_problem() checks and
/// nobody here: of an invalid camera the rays may be NaN, which miss; with an invalid map they are
/// made of foreign memory.
CameraView build_camera(const Camera& camera, int width, int height,
                        const DistortionMap* map = nullptr, const LensStack* lens = nullptr);

}  // namespace boule
