#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// Text dumps of LAMMPS: "ITEM: ATOMS" and a row for each particle; frame after frame.
extern const ParticleFormat dump_format;

}  // namespace boule
