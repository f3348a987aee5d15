#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// GRO files of GROMACS: a title, a count, a line for each atom, and the box; frame after frame.
/// Lengths are in nm.
extern const ParticleFormat gro_format;

}  // namespace boule
