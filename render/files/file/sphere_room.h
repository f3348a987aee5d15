#pragma once

#include <cstddef>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace boule {

/// Makes room for `more` spheres or capsules behind those that are there, and at least for half as
/// many again: otherwise each of many small files would copy all of them.
template <class Primitive>
void make_room(std::vector<Primitive>& primitives, std::size_t more);

/// Appends some that are set later. Their memory is new: all threads have the system clear it.
template <class Primitive>
void append_blank(std::vector<Primitive>& primitives, std::size_t count,
                  const ParallelFor& parallel_for);

}  // namespace boule
