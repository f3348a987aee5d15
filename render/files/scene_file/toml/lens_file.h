#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/lens.h"

namespace boule {

/// Reads a lens prescription. It has a line for each surface or stop, from the scene to the film,
/// with four numbers: radius of curvature (0: flat), thickness up to the next surface, index of
/// refraction up to there (air_if_none()), diameter. # begins a comment. Each surface is checked,
/// by itself and by its width beside the last one's: a Diagnostic has the line. Whether they are a
/// lens together find_problem() of the camera says.
Result<std::vector<LensSurface>> read_lens(const std::string& path);

/// The index 0, which pbrt's prescriptions have at the stop, is that of air.
inline float air_if_none(float index) { return index == 0 ? 1 : index; }

}  // namespace boule
