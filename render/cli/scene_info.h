#pragma once

#include <nlohmann/json.hpp>

#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// What a scene holds: size, counts, those of instances expanded, bounds of the spheres, camera,
/// background, lights, materials, warnings. Numbers are written as short as they can be and still
/// be the float that is meant. What the scene leaves out is there as it will be rendered, and
/// "notes" say so.
nlohmann::ordered_json scene_info(LoadedScene loaded, const std::string& path);

}  // namespace boule::cli
