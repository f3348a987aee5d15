#pragma once

#include "render/files/particle_file/frame/particle_format.h"

namespace boule {

/// PLY in its three encodings: the points are the element "vertex", all others are left out with a
/// note. "scalar_NAME" is NAME; red, green, blue and alpha of whole numbers are from 0 to 1.
extern const ParticleFormat ply_format;

}  // namespace boule
