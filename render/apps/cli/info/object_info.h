#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::cli {

/// How many of a scene's primitives of a kind and instances are listed one by one.
inline constexpr std::size_t most_told = 8;

/// The first primitives and instances of a valid scene, whose points are counted from
/// `origin`, and its groups with those of each. Points are told as the scene file counts them.
nlohmann::ordered_json spheres_info(const Scene& scene, const Vec3d& origin);
/// Adds the first few of all other kinds: "first_planes", and so on.
void add_others(nlohmann::ordered_json& json, const Scene& scene, const Vec3d& origin);
/// The first few clip planes.
nlohmann::ordered_json clips_info(const Scene& scene, const Vec3d& origin);
nlohmann::ordered_json instances_info(const LoadedScene& loaded);
nlohmann::ordered_json groups_info(const LoadedScene& loaded);

/// The box around all spheres and capsules, rounded to float before `origin` is added; null where
/// there are none. Planes are infinite and left out.
nlohmann::ordered_json bounds_info(const Scene& scene, const Vec3d& origin);

}  // namespace boule::cli
