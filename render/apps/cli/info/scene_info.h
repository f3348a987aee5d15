#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/files/scene_file/scene_file.h"

namespace boule::cli {

/// Describes a scene with every field that a scene file can set: settings, counts (those of
/// instances expanded), bounds of the spheres, camera, background, lights, materials, the first few
/// spheres, planes and instances, the names of data files, and warnings. Each number is the
/// shortest that reads back as the same float. A camera or lights that the scene leaves out are
/// given as they will be rendered, and "notes" say so.
nlohmann::ordered_json scene_info(LoadedScene loaded, const std::string& path);

/// The same for people: a line for each, lists below their names.
std::string scene_info_text(const nlohmann::ordered_json& info);

}  // namespace boule::cli
