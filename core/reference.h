#pragma once

#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::reference {

/// The scalar path: the lecture's maths in double, one ray and one primitive at a time, every pair.
/// It is written independently of the kernels, and solver `robust` must equal it bit for bit. It
/// takes any numbers: rays and primitives with NaN, infinity or without a direction miss. It throws
/// nothing. Precondition: at most max_primitives.

/// The part of a ray's line that is in a primitive: from `enter` to `leave`, which are equal for a
/// tangent, and NaN for a line that misses. The interval of the ray is ignored. A plane bounds the
/// half-space behind it, so one of the two is infinite. A ray that leaves a sphere or capsule on
/// its inside has entered it before: at -inf.
struct Chord {
  double enter, leave;
};
/// `leaves`: the ray starts on this very primitive.
Chord find_chord(const Ray& ray, const Sphere& sphere, bool leaves);
Chord find_chord(const Ray& ray, const Plane& plane, bool leaves);
Chord find_chord(const Ray& ray, const Capsule& capsule, bool leaves);

/// Whether a chord has a part of the ray between tmin and tmax, at most the largest float; that of
/// a plane, whether the ray crosses it there.
bool overlaps(const Chord& chord, const Ray& ray, const Sphere& sphere);
bool overlaps(const Chord& chord, const Ray& ray, const Plane& plane);
bool overlaps(const Chord& chord, const Ray& ray, const Capsule& capsule);

/// t of the nearest intersection with tmin < t <= tmax, or inf. `leaves`: the ray starts on this
/// very primitive.
double intersect(const Ray& ray, const Sphere& sphere, bool leaves);
double intersect(const Ray& ray, const Plane& plane, bool leaves);
double intersect(const Ray& ray, const Capsule& capsule, bool leaves);

/// The nearest hit over all; at equal t, the lower id. Ids: spheres in order, then planes, then
/// capsules.
Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes,
                std::span<const Capsule> capsules = {});

/// True if the ray hits a primitive with tmin < t <= tmax.
bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes,
             std::span<const Capsule> capsules = {});

}  // namespace boule::reference
