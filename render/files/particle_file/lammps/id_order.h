#pragma once

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// An error about the particle of a row, from 0: at its line, where the first row is line
/// `first_line` of the file; with the particle, counted from 1, where `first_line` is 0.
Diagnostic error_at_row(std::uint64_t first_line, std::uint64_t row, std::string message,
                        std::string key = {});

/// Sorts the particles by their number column "id", so that a particle keeps its place from frame
/// to frame. An error if an id is no whole number or occurs twice; it is that of the
/// second one, as error_at_row() says it. Frames without ids stay as they are.
Status sort_by_id(ParticleFrame& frame, std::uint64_t first_line, const ParallelFor& parallel_for);

}  // namespace boule
