#pragma once

#include <cstdint>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boule {

/// 64 bits that tell scenes apart: a hash of all values that a picture of the scene depends on,
/// camera, background, ambient light, materials, lights and objects in order, those of instances as
/// if they were written out. Names, image and render settings are not in it, nor is the file's
/// wording: a scene has the same hash from TOML, from .npy and from memory, on every machine. Not
/// cryptographic. Precondition, not checked: a valid scene (validate()). Throws std::bad_alloc.
std::uint64_t scene_hash(const Scene& scene, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
