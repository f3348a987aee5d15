#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/primitive.h"

namespace boule {

/// The plane through a polygon: its first vertex and its unit normal, which points to where the
/// vertices run counterclockwise (Newell's method, Graphics Gems III). A polygon is refused, with a
/// Diagnostic that has a message only, if its area is below 1e-6 of its extent squared, or if a
/// vertex is off the plane by more than 1e-3 of its extent.
Result<Plane> plane_through(const std::vector<Vec3f>& vertices);

}  // namespace boule
