#pragma once

#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::reference {

/// The scalar path: the lecture's maths in double, one ray and one primitive at a time, every pair.
/// It is written independently of the kernels, and solver `robust` must equal it bit for bit. It
/// takes any numbers: rays and primitives with NaN, infinity or without a direction miss. It throws
/// nothing. Precondition: at most max_primitives.

/// t of the nearest intersection with tmin < t <= tmax, or inf. `leaves`: the ray starts on this
/// very primitive.
double intersect(const Ray& ray, const Sphere& sphere, bool leaves);
double intersect(const Ray& ray, const Plane& plane, bool leaves);

/// The nearest hit over all; at equal t, the lower id. Ids: spheres in order, then planes.
Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

/// True if the ray hits a primitive with tmin < t <= tmax.
bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

}  // namespace boule::reference
