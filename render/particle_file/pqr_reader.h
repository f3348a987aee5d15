#pragma once

#include "render/particle_file/particle_format.h"

namespace boule {

/// PQR: molecules with the charge and the radius of each atom, as continuum electrostatics has
/// them.
extern const ParticleFormat pqr_format;

}  // namespace boule
