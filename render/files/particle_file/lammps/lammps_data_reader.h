#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// Data files of LAMMPS, as read_data takes them: one frame.
extern const ParticleFormat lammps_data_format;

}  // namespace boule
