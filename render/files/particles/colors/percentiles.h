#pragma once

#include <array>
#include <cstddef>

#include "core/base/parallel.h"
#include "render/files/particles/particle_columns.h"

namespace boule {

/// Of so many numbers in order, without those that are missing (NaN), the ones at places
/// floor(0.01 (n - 1)) and ceil(0.99 (n - 1)): the 1st and 99th percentile. The first is above the
/// second where there are no numbers. The same for any threads.
std::array<double, 2> percentiles(const ParticleNumbers& numbers, std::size_t count,
                                  const ParallelFor& parallel_for);

}  // namespace boule
