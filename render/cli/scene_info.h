#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// What a scene holds, every field that a scene file can set: settings, counts, those of instances
/// expanded, bounds of the spheres, camera, background, lights, materials, warnings; of spheres,
/// planes and instances the first few; data files by their names. Numbers are written as short as
/// they can be and still be the float that is meant. What the scene leaves out is there as it will
/// be rendered, and "notes" say so.
nlohmann::ordered_json scene_info(LoadedScene loaded, const std::string& path);

/// The same for people: a line for each, lists below their names.
std::string scene_info_text(const nlohmann::ordered_json& info);

}  // namespace boule::cli
