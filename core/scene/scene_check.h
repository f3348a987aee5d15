#pragma once

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boule {

/// validate(scene) with the spheres checked by several threads. The Diagnostic is the same for any
/// number of threads. Passes on exceptions of `parallel_for`.
Status validate_in_parallel(const Scene& scene, const ParallelFor& parallel_for);

}  // namespace boule
