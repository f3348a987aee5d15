#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "render/scene_file/scene_file.h"

namespace boule {

/// Reads the TOML scene in `text`; `path` names it in errors, and what the scene refers to is
/// relative to it. The scene has passed validate().
Result<LoadedScene> read_toml(std::string_view text, const std::string& path,
                              std::optional<int> frame = {});

}  // namespace boule
