#pragma once

#include "render/particle_file/particle_format.h"

namespace boule {

/// Text dumps of LAMMPS: "ITEM: ATOMS" and a row for each particle; frame after frame.
extern const ParticleFormat dump_format;

}  // namespace boule
