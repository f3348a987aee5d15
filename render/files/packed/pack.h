#pragma once

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/files/packed/pack_tree.h"
#include "render/files/packed/sphere_source.h"

namespace boule {

/// What is packed into a file.
struct PackRequest {
  Scene scene;  ///< valid, without spheres, groups and instances
  Vec3d origin;
  SphereSource& spheres;  ///< made of the scene's materials
  std::string output;
  PackMeans means;  ///< `beside` is set to the output
};

/// What packing has made.
struct PackResult {
  std::uint64_t spheres = 0, bytes = 0;
  std::size_t chunks = 0;
};

/// Packs a scene into a file (packed_format.h), which appears when it is complete. All rays have
/// the hits that they have in the scene, with the same ids. Needs little more memory than it was
/// given, whatever the number of spheres; if they do not fit, the folder of the output has to have
/// room for them twice. Throws std::bad_alloc, and what `parallel_for` throws.
Result<PackResult> pack(PackRequest request);

}  // namespace boule
