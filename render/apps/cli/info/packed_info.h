#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::cli {

/// What `boule info` tells of a packed scene: its scene, and what the file is made of.
Result<nlohmann::ordered_json> packed_info(const InfoCommand& command, const std::string& path,
                                           const SceneFileOptions& options);

}  // namespace boule::cli
