#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/files/scene_file/scene_file.h"

namespace boule {

/// Gives the scene the camera of --camera, whose keys are `keys`, in this frame of a series; empty:
/// it keeps its own. One that is to be fitted is left out, and `fit` says how. Names of files in it
/// are relative to the working directory.
Status use_camera(const std::string& keys, std::optional<int> frame, LoadedScene& loaded);

}  // namespace boule
