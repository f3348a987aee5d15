#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/camera.h"

namespace boule::cli {

/// Every field of a camera; of a lens its focal length and f-number too.
nlohmann::ordered_json camera_info(const Camera& camera);

}  // namespace boule::cli
