#pragma once

#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// The geometry of a valid scene, whose spheres are taken. `groups`: what
/// share_or_expand() returned for the scene; each group is one tree, however often it is shown.
/// Throws std::bad_alloc, and what `parallel_for` throws.
Geometry geometry_of(Scene& scene, const std::optional<std::vector<ShownGroup>>& groups,
                     const ParallelFor& parallel_for);

}  // namespace boule
