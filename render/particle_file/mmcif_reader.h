#pragma once

#include "render/particle_file/particle_format.h"

namespace boule {

/// CIF files: macromolecules (mmCIF), a frame for each model, and small molecules. gemmi reads
/// them, as a whole.
extern const ParticleFormat mmcif_format;

}  // namespace boule
