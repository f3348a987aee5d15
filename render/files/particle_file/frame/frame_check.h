#pragma once

#include <cstdint>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// An error if a particle is at no finite position or, unless the file is read leniently, a column
/// has an infinite number: with the particle, counted from 1, of which `before` are in other parts.
Status check_values(const ParticleFrame& frame, bool lenient, std::uint64_t before = 0);

}  // namespace boule
