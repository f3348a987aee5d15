#pragma once

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boule {

/// validate(scene), whose spheres several threads check. The Diagnostic is the same for any of
/// them. Passes on what `parallel_for` throws.
Status validate_in_parallel(const Scene& scene, const ParallelFor& parallel_for);

}  // namespace boule
