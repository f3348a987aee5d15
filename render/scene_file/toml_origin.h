#pragma once

#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/particles/particle_spheres.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// What floats are too coarse for: the particles of a scene.
using ParticleLists = std::vector<const ParticleSpheres*>;

/// The point that `origin = "auto"` stands for: 0, if rounding moves no centre that is counted from
/// there by more than 2^-16 of the smallest radius, which a picture of 65535 pixels could show.
/// Else the point with the fewest decimal digits near the middle of the particles (that of their
/// cell, or of the box around their centres) from where this holds. Else a point near the middle,
/// if it makes the rounding eight times smaller than 0 does. Else 0.
Vec3d choose_origin(const ParticleLists& particles);

/// Reads the key `origin` of a scene: "auto", which is the default, or a point. What was chosen
/// automatically, if it is not 0, is told in a note. Errors are reported through the table.
Vec3d read_origin(TomlTable& root, const ParticleLists& particles, std::vector<std::string>& notes);

}  // namespace boule
