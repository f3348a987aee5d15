#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "core/scene/camera_fit.h"
#include "core/scene/distortion.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// Reads the table [camera]. Keys that are absent have the defaults of core/scene/camera.h; errors
/// are reported through the table.
Camera read_camera(TomlTable& table);

/// Reads the table of a camera that is fitted to the scene, `fit = true`; nothing if it is not.
std::optional<CameraFit> read_camera_fit(TomlTable& table);

/// Reads the table [camera.distortion], with the picture that it names, if it is there.
std::optional<DistortionMap> read_distortion(TomlTable& camera);

}  // namespace boule
