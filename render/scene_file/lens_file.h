#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/lens.h"

namespace boule {

/// Reads a lens prescription: a line for each surface or stop, from the scene to the film, of four
/// numbers: radius of curvature (0: flat), thickness to the next, index of refraction up to it,
/// diameter. # begins a comment. The Diagnostic has the line; the numbers are checked by
/// find_problem().
Result<std::vector<LensSurface>> read_lens(const std::string& path);

}  // namespace boule
