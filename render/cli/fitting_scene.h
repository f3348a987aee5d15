#pragma once

#include <string>

#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// load_scene(), and an error as well if what the scene's instances show does not fit into memory.
Result<LoadedScene> load_fitting_scene(const std::string& path,
                                       const SceneFileOptions& options = {});

}  // namespace boule::cli
