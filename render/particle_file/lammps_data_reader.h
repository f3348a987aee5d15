#pragma once

#include "render/particle_file/particle_format.h"

namespace boule {

/// Data files of LAMMPS, as read_data takes them: one frame.
extern const ParticleFormat lammps_data_format;

}  // namespace boule
