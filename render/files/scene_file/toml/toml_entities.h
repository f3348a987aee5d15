#pragma once

#include "core/scene/scene.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// One function for each kind of table of the scene file. Keys that are absent have the defaults of
/// the structs in core/scene; errors are reported through the table.

ImageSettings read_image_settings(TomlTable& table);
RenderSettings read_render(TomlTable& table);
/// The table of the background also has the scene's ambient light and its backdrop.
Background read_background(TomlTable& table, Scene& scene);
Material read_material(TomlTable& table);
Light read_light(TomlTable& table);
Clip read_clip(TomlTable& table);

}  // namespace boule
