#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "core/scene/distortion.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// Reads the tables [camera] and [camera.distortion], with the picture that the latter names. Keys
/// that are absent have the defaults of core/scene/camera.h; errors are reported through the table.
Camera read_camera(TomlTable& table, std::optional<DistortionMap>& distortion);

}  // namespace boule
