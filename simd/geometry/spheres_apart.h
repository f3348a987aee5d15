#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {

/// The ids, in order, of the spheres to keep out of the tree and test against every ray: those that
/// in_filter_range() refuses, and up to tuning::most_giants giants, whose boxes nearly every ray
/// would meet. Without the giants the box of all others is smaller, and the rest is judged again: a
/// dome within a ground sphere is a giant as well.
std::vector<std::int32_t> find_spheres_apart(const std::vector<Sphere>& spheres,
                                             const ParallelFor& parallel_for);

/// Keeps only the first kept_copies (binary_tree.h) of exact copies, with the same centre and
/// radius, and appends the others to `copies`. In order, as `ids` are.
std::vector<std::int32_t> without_copies(std::vector<std::int32_t> ids,
                                         const std::vector<Sphere>& spheres,
                                         std::vector<SphereCopy>& copies);

/// Turns all spheres, except those of the sorted ids `apart`, into spheres of the build, in place:
/// they are valid as long as `spheres` is left alone. Their materials go to materials[id], unless
/// `materials` is null.
std::span<BuildSphere> take_others(std::vector<Sphere>& spheres,
                                   const std::vector<std::int32_t>& apart, MaterialRef* materials,
                                   const ParallelFor& parallel_for);

}  // namespace boule
