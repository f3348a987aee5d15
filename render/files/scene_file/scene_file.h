#pragma once

#include <string>

#include "core/base/error.h"
#include "render/files/scene_file/loaded/loaded_scene.h"

namespace boule {

/// Reads a scene by its extension: .toml, .nff (Haines' SPD), .boule (packed), or .npy: spheres
/// alone, N x 4. An error is a Diagnostic with file, line, column and key. A scene that is too
/// large to be prepared in the available memory is an error, too. Takes any name, text and frame;
/// only regular files are read.
Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options = {});

/// Reads the text of a TOML scene as if it stood in a file at `shown_path`, which need not exist:
/// errors name it, and the names of data files are relative to its folder.
Result<LoadedScene> load_scene_text(const std::string& toml, const std::string& shown_path,
                                    const SceneFileOptions& options = {});

}  // namespace boule
