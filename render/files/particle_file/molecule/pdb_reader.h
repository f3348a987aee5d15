#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// PDB files: records of fixed columns; model after model. What a line's columns mean is gemmi's
/// matter, numbers are checked before.
extern const ParticleFormat pdb_format;

}  // namespace boule
