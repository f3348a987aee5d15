#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// XYZ and extended XYZ: a count, a line of comment, and a line for each particle; frame after
/// frame.
extern const ParticleFormat xyz_format;

}  // namespace boule
