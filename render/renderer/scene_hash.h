#pragma once

#include <cstdint>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boule {

/// A hash of 64 bits that identifies scenes. It covers all values that affect a picture of the
/// scene: camera, background, ambient light, materials, lights and objects in order, with instances
/// expanded. Names, image and render settings, and the file's wording are left out: a scene has the
/// same hash from TOML, from .npy and from memory, on every machine. Not cryptographic.
/// Precondition, unchecked: a valid scene (validate()). Throws std::bad_alloc.
std::uint64_t scene_hash(const Scene& scene, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
