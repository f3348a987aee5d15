#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "render/files/scene_file/loaded/loaded_scene.h"

namespace boule {

/// Reads Haines' Neutral File Format as the Standard Procedural Databases write it: comments and
/// the entities v, b, l, f, s, p and pp, each of whole lines. `path` names the text in errors,
/// `origin` is that of a series. The scene has passed validate().
Result<LoadedScene> read_nff(std::string_view text, const std::string& path, PolygonPolicy polygons,
                             const std::optional<Vec3d>& origin = {});

}  // namespace boule
