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
  std::optional<int> frame{};  ///< of a series: selects the camera's position and the data files
};

/// A scene that has passed validate(), warnings for the user, and the paths of the data files that
/// were read besides the scene file.
struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  ///< each "FILE:LINE: warning: TEXT"
  std::vector<std::string> data_files{};
};

/// Reads a scene by its extension: .toml, .nff (Haines' SPD), or .npy: spheres alone, N x 4.
/// An error is a Diagnostic with file, line, column and key; it is an error, too, if the scene is
/// too large to be prepared in the memory there is. Takes any name, text and frame; only regular
/// files are read.
Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options = {});

}  // namespace boule
