#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// The ids, in order, of the spheres that a tree had better not hold and that every ray is tested
/// against: those that in_filter_range() refuses, and up to tuning::most_giants giants, whose boxes
/// nearly every ray would meet. Once giants are away the box of all others is smaller and the rest
/// is judged again: a dome within a ground sphere is a giant as well.
std::vector<std::int32_t> find_spheres_apart(const std::vector<Sphere>& spheres,
                                             const ParallelFor& parallel_for);

/// Of exact copies, same centre and same radius, only the first kept_copies (binary_tree.h). In
/// order, as `ids` are.
std::vector<std::int32_t> without_copies(std::vector<std::int32_t> ids,
                                         const std::vector<Sphere>& spheres);

/// Makes all spheres but those of the ids `apart`, which are in order, spheres of the build: they
/// lie where the spheres were, as long as `spheres` is not used. Their materials go to
/// materials[id], unless `materials` is null.
std::span<BuildSphere> take_others(std::vector<Sphere>& spheres,
                                   const std::vector<std::int32_t>& apart, MaterialRef* materials,
                                   const ParallelFor& parallel_for);

}  // namespace boule
