#pragma once

#include <vector>

#include "core/scene/primitive.h"

namespace boule {

/// Writes a .npy file for [[spheres]]: float32 rows of centre and radius, the same bytes on every
/// machine. The exit code of a program that does nothing else; 1, and a line on standard error, if
/// it cannot be written.
int write_spheres(const std::vector<Sphere>& spheres, const char* path);

}  // namespace boule
