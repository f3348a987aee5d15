#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace boule {

/// Puts together what all spheres tell: add(part, sphere) for each of them, beginning with `start`,
/// and join(part, other) for what threads have found in pieces of them, in order. How they are cut
/// does not depend on the threads.
template <class Part, class Add, class Join>
Part fold_spheres(std::span<const Sphere> spheres, const ParallelFor& parallel_for,
                  const Part& start, const Add& add, const Join& join) {
  constexpr std::size_t size = std::size_t{1} << 16;
  std::vector<Part> parts((spheres.size() + size - 1) / size, start);
  parallel_for(parts.size(), [&](std::size_t i) {
    Part part = start;
    const std::span<const Sphere> rest = spheres.subspan(i * size);
    for (const Sphere& sphere : rest.first(std::min(size, rest.size()))) add(part, sphere);
    parts[i] = part;
  });
  Part all = start;
  for (const Part& part : parts) join(all, part);
  return all;
}

}  // namespace boule
