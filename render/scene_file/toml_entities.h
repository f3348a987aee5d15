#pragma once

#include "core/scene/scene.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// One function for each kind of table of the scene file. Keys that are absent have the defaults of
/// the structs in core/scene; errors are reported through the table.

ImageSettings read_image(TomlTable& table);
RenderSettings read_render(TomlTable& table);
Background read_background(TomlTable& table, Color& ambient);
Material read_material(TomlTable& table);
Light read_light(TomlTable& table);

}  // namespace boule
