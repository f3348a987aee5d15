#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// Tables as text: a row for each particle, columns between commas, semicolons, tabs or blanks,
/// named by a header line, a comment before the rows, or ParticleFileOptions::columns.
extern const ParticleFormat table_format;

/// True if the first row of a text is x, y, z, or a species before them.
bool looks_like_points(std::string_view text);

/// Reads such rows as a table whose fourth number is no radius, with a note.
Result<std::unique_ptr<ParticleReader>> open_points(MappedText bytes,
                                                    const ParticleFileOptions& options,
                                                    const ParallelFor& parallel_for);

}  // namespace boule
