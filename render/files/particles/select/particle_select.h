#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// Which particles meet the expression ParticleStyle::select: 1 or 0 for each. An error about the
/// key "select": what parse_select() refuses, a column that is not there, and a comparison of a
/// text with a number.
Result<std::vector<std::uint8_t>> select_particles(const ParticleFrame& frame,
                                                   const std::string& select,
                                                   const ParallelFor& parallel_for);

/// Drops the particles that are not selected from all lists of the frame.
void keep_particles(ParticleFrame& frame, const std::vector<std::uint8_t>& selected,
                    const ParallelFor& parallel_for);

}  // namespace boule
