#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// True if the first row of a text is x, y, z, or a species before them.
bool looks_like_points(std::string_view text);

/// Reads such rows as a table whose fourth number is no radius, with a note.
Result<std::unique_ptr<ParticleReader>> open_points(MappedText bytes,
                                                    const ParticleFileOptions& options,
                                                    const ParallelFor& parallel_for);

}  // namespace boule
