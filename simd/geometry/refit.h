#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {

/// The work that rays have in a tree: the areas of its boxes, in those of its root's children. It
/// tells trees over the same slots apart.
double tree_cost(const Bvh& tree);

/// Moves the spheres of a tree: that with the id k becomes spheres[k], except for its material. All
/// stay in their slots; the boxes are made anew, so every hit is that of a new tree. Returns false,
/// with the tree unchanged, if it takes a new one: if the tree left copies out, or if a filter
/// cannot judge a sphere (in_filter_range()). Passes on exceptions of `parallel_for`, which leave
/// the tree useless. Preconditions: the tree has nodes, and as many spheres.
bool refit(Bvh& tree, std::span<const Sphere> spheres, const ParallelFor& parallel_for);

}  // namespace boule
