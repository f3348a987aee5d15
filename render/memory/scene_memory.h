#pragma once

#include <cstdint>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

/// Bytes that so many spheres take, and those that finding them by a tree takes at most, while it
/// is built.
constexpr std::uint64_t bytes_of_spheres(std::uint64_t count) { return count * sizeof(Sphere); }
constexpr std::uint64_t bytes_of_tree(std::uint64_t spheres) {
  constexpr std::uint64_t measured = 90;  // of a sphere, once there are millions
  return spheres * measured;
}

/// An error if preparing a scene, with what its instances show, needs more memory than there is:
/// known in no time and before any is taken. Takes any scene; of one that validate() refuses it
/// says nothing.
Status check_scene_memory(const Scene& scene);

}  // namespace boule
