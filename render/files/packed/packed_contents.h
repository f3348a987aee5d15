#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boule {

/// The spheres of one chunk. Their ids follow those of the chunks before it.
struct PackedChunk {
  std::uint64_t spheres = 0;  ///< ids; of copies of one sphere not all have a slot
  std::uint64_t scanned = 0;  ///< slots in front that are in no leaf
  MaterialRef material;       ///< of all spheres, where the chunk has no section of materials
};

/// All of a packed scene but its large arrays.
struct PackedContents {
  Scene scene;            ///< without spheres, groups and instances
  PackedSpheres spheres;  ///< without tree and file
  std::vector<PackedChunk> chunks;
  Vec3d origin;  ///< subtracted from all points of the scene
};

/// As bytes, and back. The scene that is read has passed validate_all_but_primitives(), and its
/// planes, and the spheres that are listed, are valid; the Diagnostic has a message only.
std::string encode(const PackedContents& contents);
Result<PackedContents> decode(std::string_view bytes);

}  // namespace boule
