#pragma once

#include "core/scene/scene.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// What a table of the scene file says, one function per noun. Keys that are absent have the
/// defaults of the structs in core/scene; anything wrong is reported through the table.

ImageSettings read_image(TomlTable& table);
RenderSettings read_render(TomlTable& table);
Background read_background(TomlTable& table, Color& ambient);
Material read_material(TomlTable& table);
Light read_light(TomlTable& table);

}  // namespace boule
