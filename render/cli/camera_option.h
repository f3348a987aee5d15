#pragma once

#include "core/base/error.h"
#include "render/cli/options.h"
#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// Gives the scene the camera of --camera, if there is one. Names of files in it are relative to
/// the working directory.
Status use_camera(const RenderCommand& command, LoadedScene& loaded);

}  // namespace boule::cli
