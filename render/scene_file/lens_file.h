#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/lens.h"

namespace boule {

/// Reads a lens prescription. It has a line for each surface or stop, from the scene to the film,
/// with four numbers: radius of curvature (0: flat), thickness up to the next surface, index of
/// refraction up to there, diameter. # begins a comment. A Diagnostic has the line. The numbers are
/// not checked here, but by find_problem().
Result<std::vector<LensSurface>> read_lens(const std::string& path);

}  // namespace boule
