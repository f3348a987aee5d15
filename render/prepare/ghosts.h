#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

struct PreparedScene;

/// The primitives of a scene whose material is a Ghost, and the ids of the others.
struct Ghosts {
  /// The ghosts with the scene's clip planes. Of the rest it has what hits and their materials
  /// need.
  std::shared_ptr<const PreparedScene> scene;
  std::vector<std::uint32_t> sphere_ids;   ///< of what is left, by their id without ghosts: that in
                                           ///< the scene
  std::vector<std::uint32_t> capsule_ids;  ///< likewise, both less that of the first capsule
  std::uint32_t spheres = 0;               ///< of the scene, with ghosts
};

/// Moves the ghosts out of a valid scene without instances into `ghosts`, and their places out of
/// outline_groups. Returns all but Ghosts::scene. An error if a plane or packed spheres are ghosts.
/// Throws std::bad_alloc.
Result<Ghosts> take_ghosts(Scene& scene, Scene& ghosts);

}  // namespace boule
