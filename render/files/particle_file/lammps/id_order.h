#pragma once

#include <cstdint>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// Sorts the particles by their number column "id", so that a particle keeps its place from frame
/// to frame. An error if an id is no whole number or occurs twice; its line is that of the
/// particle, of the second one, where the first row of the file is line `first_line`. Frames
/// without ids stay as they are.
Status sort_by_id(ParticleFrame& frame, std::uint64_t first_line, const ParallelFor& parallel_for);

}  // namespace boule
