#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

/// Makes room for `more` spheres behind those that are there, by half again at least: many small
/// files in a row must not copy all spheres for each of them.
void make_room(std::vector<Sphere>& spheres, std::size_t more);

}  // namespace boule
