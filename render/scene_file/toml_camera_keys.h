#pragma once

#include <optional>

#include "render/scene_file/first_error.h"
#include "render/scene_file/toml_document.h"

namespace boule {

/// Puts eye, look_at and fov of one frame in place of the tables [[camera.key]] of a scene file:
/// what reads [camera] afterwards sees a camera that stands still. Each of the three follows the
/// keys that name it, component by component (monotone_cubic()), in double. No frame: that of the
/// first key. `root` holds the members of the whole file.
void apply_camera_keys(TomlMembers& root, std::optional<int> frame, FirstError& error);

}  // namespace boule
