#pragma once

#include "render/particle_file/particle_format.h"

namespace boule {

/// Tables as text: a row for each particle, columns between commas, semicolons, tabs or blanks,
/// named by a header line, a comment before the rows, or ParticleFileOptions::columns.
extern const ParticleFormat table_format;

}  // namespace boule
