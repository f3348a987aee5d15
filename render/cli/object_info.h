#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace boule::cli {

/// Of how many of a scene's spheres, planes and instances each one is told.
inline constexpr std::size_t most_told = 8;

/// The first spheres, planes, instances of a valid scene, its groups with what is in each.
nlohmann::ordered_json spheres_info(const Scene& scene);
nlohmann::ordered_json planes_info(const Scene& scene);
nlohmann::ordered_json instances_info(const Scene& scene);
nlohmann::ordered_json groups_info(const Scene& scene);

/// The box around all spheres, rounded to float; null where there is none; planes have no end.
nlohmann::ordered_json bounds_info(const std::vector<Sphere>& spheres);

}  // namespace boule::cli
