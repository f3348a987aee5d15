#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// CIF files: macromolecules (mmCIF), a frame for each model, and small molecules. gemmi reads
/// them, as a whole.
extern const ParticleFormat mmcif_format;

}  // namespace boule
