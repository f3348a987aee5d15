#pragma once

#include <optional>

#include "core/scene/scene.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// The scene of a packed file, and the origin that its points are counted from.
struct PackedPart {
  Scene scene;
  Vec3d origin;
};

/// Opens a packed scene. Throws std::bad_alloc.
Result<PackedPart> open_packed(const std::string& path, const SceneFileOptions& options);

/// Opens the packed scene that the tables [[packed]] of a scene name: one at most. Errors are
/// reported through the tables.
std::optional<PackedPart> read_packed(TomlTable& root, const SceneFileOptions& options);

}  // namespace boule
