#pragma once

#include <string>
#include <string_view>

#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/toml/toml_document.h"

namespace boule {

/// Reads the TOML scene in `text`. `path` names it in errors; names of data files are relative to
/// its folder. The scene has passed validate().
Result<LoadedScene> read_toml(std::string_view text, const std::string& path,
                              const SceneFileOptions& options = {});

/// The same for text that was parsed. Precondition: the value is a table.
Result<LoadedScene> read_toml_tree(TomlValue root, const std::string& path,
                                   const SceneFileOptions& options);

}  // namespace boule
