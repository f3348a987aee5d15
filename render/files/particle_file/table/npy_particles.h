#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// .npy files of particles: rows of numbers (x, y, z, radius and more), or a structured array whose
/// named fields are the columns.
extern const ParticleFormat npy_format;

}  // namespace boule
