#pragma once

#include <array>
#include <cstddef>

#include "core/base/parallel.h"
#include "render/particles/particle_columns.h"

namespace boule {

/// Of count numbers in order, those at places floor(0.01 (count - 1)) and ceil(0.99 (count - 1)):
/// the 1st and 99th percentile. The same for any threads. Precondition: count > 0.
std::array<double, 2> percentiles(const ParticleNumbers& numbers, std::size_t count,
                                  const ParallelFor& parallel_for);

}  // namespace boule
