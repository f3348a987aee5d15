#pragma once

#include <string>

#include "core/base/error.h"
#include "render/files/scene_file/scene_file.h"

namespace boule {

/// Gives the scene the camera of --camera, whose keys are `keys`, in the frame of `series`; empty:
/// it keeps its own. One that is to be fitted is left out, and `fit` says how. Names of files in it
/// are relative to the working directory.
Status use_camera(const std::string& keys, const SceneFileOptions& series, LoadedScene& loaded);

}  // namespace boule
