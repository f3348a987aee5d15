#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

/// What an NFF polygon becomes: its infinite plane, nothing, or an error.
enum class PolygonPolicy { plane, skip, error };

/// How a scene file is read.
struct SceneFileOptions {
  PolygonPolicy polygons = PolygonPolicy::plane;
  std::optional<int> frame{};  ///< of a series: where the camera is, and which data files are meant
};

/// A scene that passed validate(), remarks for the user that are not errors, and the data files
/// that it was read from beside its own.
struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  ///< each "FILE:LINE: warning: TEXT"
  std::vector<std::string> data_files{};
};

/// Reads a scene by its extension: .toml, .nff (Haines' SPD), or .npy: spheres alone, N x 4.
/// Anything wrong is a Diagnostic with file, line, column and key, and so is a scene that could not
/// be prepared in the memory there is. Any name will do, any text and any frame; only regular files
/// are read.
Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options = {});

}  // namespace boule
