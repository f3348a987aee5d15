#pragma once

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// The frame that lies `share` of the way from one frame to the next, 0 < share < 1. Particles are
/// the same where they have the same "id", or the same place where there is none. A position moves
/// along the shortest way through the periodic faces of the cell, which moves likewise: a particle
/// that leaves one face enters at the opposite one, and if it was outside of the cell before, it
/// changes over halfway. Numbers that are not all whole move, too, and so does the time; all else
/// is that of the first frame. An error if the frames have different particles, or an id twice.
Result<ParticleFrame> between_frames(ParticleFrame first, const ParticleFrame& next, double share);

}  // namespace boule
