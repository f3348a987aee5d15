#pragma once

#include <string>
#include <string_view>

#include "render/scene_file/scene_file.h"

namespace boule {

/// Reads the TOML scene in `text`. `path` names it in errors; names of data files are relative to
/// its folder. The scene has passed validate().
Result<LoadedScene> read_toml(std::string_view text, const std::string& path,
                              const SceneFileOptions& options = {});

}  // namespace boule
