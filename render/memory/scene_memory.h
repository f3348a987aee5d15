#pragma once

#include <cstdint>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

/// Bytes that so many spheres take.
constexpr std::uint64_t bytes_of_spheres(std::uint64_t count) { return count * sizeof(Sphere); }

/// The most bytes that spheres and the tree over them take at any time while it is built in their
/// place, and afterwards (build_bvh()); the spheres have colours of their own or not.
constexpr std::uint64_t bytes_of_tree(std::uint64_t spheres) {
  constexpr std::uint64_t measured = 32;  // per sphere, of millions of them
  return spheres * measured;
}

/// The same of capsules, which stay beside their tree while it is built.
constexpr std::uint64_t bytes_of_capsule_tree(std::uint64_t capsules) {
  constexpr std::uint64_t measured = 72;  // per capsule, of millions of them
  return capsules * measured;
}

/// An error if preparing a scene, with all that its instances show, needs more memory than there
/// is. It is quick. Takes any scene; no error for one that validate() refuses. Throws
/// std::bad_alloc, as the next one does.
Status check_scene_memory(const Scene& scene);
/// The same for what else the reference path needs: all spheres in one list, those of groups that
/// are shared too. For other scenes it has no error.
Status check_reference_memory(const Scene& scene);

}  // namespace boule
