#pragma once

#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"
#include "core/scene/light.h"

namespace boule {

/// Turns lights that are placed relative to the camera into lights of the scene (LightFrame). An
/// error about a light that float's range does not hold then.
Status place_lights(std::vector<Light>& lights, const Camera& camera);

}  // namespace boule
