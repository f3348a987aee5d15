#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// PQR: molecules with the charge and the radius of each atom, as continuum electrostatics has
/// them.
extern const ParticleFormat pqr_format;

}  // namespace boule
