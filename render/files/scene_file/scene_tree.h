#pragma once

#include <string>

#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/toml/toml_document.h"

namespace boule {

/// Reads the tree of a TOML scene that was made in memory. Objects count in the order of their
/// places. Names of data files are relative to the folder of `shown_path`, which need not be there,
/// unless options.data has them. Errors name keys; they have the file and the places of the tree.
Result<LoadedScene> load_scene_tree(TomlMembers root, const std::string& shown_path,
                                    const SceneFileOptions& options = {});

}  // namespace boule
