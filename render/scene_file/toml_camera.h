#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "core/scene/distortion.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// What the table [camera] says, and [camera.distortion], whose picture is read. Keys that are
/// absent have the defaults of core/scene/camera.h; anything wrong is reported through the table.
Camera read_camera(TomlTable& table, std::optional<DistortionMap>& distortion);

}  // namespace boule
