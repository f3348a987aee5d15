#pragma once

#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::reference {

/// The scalar path: the lecture's maths in double, one ray and one primitive at a time, every pair.
/// It is written apart from the kernels and must equal solver `robust` bit for bit. Takes any
/// numbers: what is NaN, infinite or without a direction is a miss. Throws nothing. Precondition:
/// max_primitives at most.

/// t of the nearest intersection with tmin < t <= tmax, or inf. `leaves` says that the ray starts
/// on this very primitive.
double intersect(const Ray& ray, const Sphere& sphere, bool leaves);
double intersect(const Ray& ray, const Plane& plane, bool leaves);

/// The nearest hit over all; equal t: the lower id. Ids: spheres in order, then planes.
Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

/// True if anything is met with tmin < t <= tmax.
bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

}  // namespace boule::reference
