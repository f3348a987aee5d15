#pragma once

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/material_ref.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_style.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// Gives the ghosts among the particles of a frame the style's material, in the colours that they
/// have. An error, with the key "ghost", if their selection is wrong or there is no memory.
Status make_ghosts(const ParticleFrame& frame, const ParticleStyle& style,
                   ParticleValues<MaterialRef>& materials, const ParallelFor& parallel_for);

}  // namespace boule
