#pragma once

#include <vector>

#include "core/scene/primitive.h"

namespace boule::bench {

/// The spheres of "balls", the sphereflake of Haines' Standard Procedural Databases ("A Proposal
/// for Standard Graphics Environments", IEEE CG&A 7(11), 1987), of size factor `depth`: one of
/// radius 1/2 at the origin, nine of a third of its size on its upper side, nine on each of those.
/// (9^(depth + 1) - 1) / 8 spheres, parents first. Only + - * / and roots: the same bits
/// everywhere.
std::vector<Sphere> balls(int depth);

}  // namespace boule::bench
