#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "simd/abi/bvh.h"

namespace boule {

/// Checks nodes that come from a file, so that no traversal leaves them or never ends: every child
/// is a leaf of at most 16 spheres among `leaves`, or a node behind its parent that has no other
/// parent; no way to a leaf has more than bvh_max_depth nodes; boxes hold finite numbers or are
/// empty. Nodes that nobody leads to are no error. The Diagnostic has a message only.
Status check_nodes(std::span<const BvhNode> nodes, std::uint64_t leaves,
                   const ParallelFor& parallel_for);

}  // namespace boule
