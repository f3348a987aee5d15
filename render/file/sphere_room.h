#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

/// Makes room for `more` spheres behind those that are there, and at least for half as many again:
/// otherwise each of many small files would copy all spheres.
void make_room(std::vector<Sphere>& spheres, std::size_t more);

}  // namespace boule
