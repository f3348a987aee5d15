#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/chunks.h"
#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace boule {

/// Puts together what all spheres tell: add(part, sphere) for each of them, beginning with `start`,
/// and join(part, other) for what threads have found in pieces of them, in order. How they are cut
/// depends on neither threads nor their float environments.
template <class Part, class Add, class Join>
Part fold_spheres(std::span<const Sphere> spheres, const ParallelFor& parallel_for,
                  const Part& start, const Add& add, const Join& join) {
  std::vector<Part> parts(chunks_of(spheres.size()), start);
  in_chunks(parallel_for, spheres.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              Part part = start;
              for (const Sphere& sphere : spheres.subspan(begin, end - begin)) add(part, sphere);
              parts[chunk] = part;
            });
  Part all = start;
  for (const Part& part : parts) join(all, part);
  return all;
}

}  // namespace boule
