#pragma once

#include <string>

#include "render/files/scene_file/toml/toml_table.h"
#include "render/image/read_image.h"

namespace boule {

/// Reads a picture that a scene names. Only regular files are read, as for scenes: other names are
/// refused before the image module is loaded.
Result<Image> read_picture(const std::string& path, PictureContent content);

/// The picture that a table of a scene names: one in memory (SceneData), or that of a file.
Result<Image> read_picture(TomlTable& table, const std::string& name, PictureContent content);

}  // namespace boule
