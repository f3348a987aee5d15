#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/camera.h"

namespace boule::cli {

/// Every field of a camera, whose points are counted from `origin`. A lens has its focal length and
/// f-number as well.
nlohmann::ordered_json camera_info(const Camera& camera, const Vec3d& origin);

}  // namespace boule::cli
