#pragma once

#include "core/scene/material.h"
#include "render/files/particles/particle_style.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// Reads the keys of a table [[particles]] that say how particles become spheres: all but
/// `material`. Errors are reported through the table.
ParticleStyle read_particle_style(TomlTable& table);

/// The material of the table's ghosts, in the colour of that material; none: there are no ghosts.
std::optional<Ghost> read_ghost(TomlTable& table, const Material& of);

}  // namespace boule
