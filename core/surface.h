#pragma once

#include <cstdint>
#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule {

/// Where a ray met a primitive, all in double; core/optics/incidence.h has the formulas. A ray that
/// leaves it starts at the point moved off the surface by a bound of its error: there is no epsilon
/// anywhere (lecture "Shadow acne"). Nothing here throws; numbers that are not finite make such
/// numbers.
struct Surface {
  Vec3d point;      ///< org + t dir
  Vec3d normal;     ///< geometric, unit length, turned towards the viewer
  Vec3d view;       ///< the ray's direction V, unit length
  Vec3d mirrored;   ///< R = V - 2 (N.V) N (lecture "Reflection"), unit length
  double cosine;    ///< -N.V, in [0, 1]
  double reach;     ///< what the error of `point` is relative to: F + r
  std::int32_t id;  ///< the primitive
  bool inner;       ///< it was met on the sphere's inside, or on the plane's back
  bool sphere;
};

/// Which way a ray leaves a surface: back to the viewer's side, or through it.
enum class Side { viewer, beyond };

/// The surface of the primitive that a ray met. Precondition: `hit` is a hit of this ray, no miss.
Surface find_surface(const Sphere& sphere, const Ray& ray, const Hit& hit);
Surface find_surface(const Plane& plane, const Ray& ray, const Hit& hit);

/// The same among these primitives, by id: the spheres, then the planes. Precondition, not checked:
/// there is one of that id.
Surface find_surface(std::span<const Sphere> spheres, std::span<const Plane> planes, const Ray& ray,
                     const Hit& hit);

/// Where a ray starts that leaves the surface, and what tells the solver so.
struct Departure {
  Vec3d org;            ///< the surface's point, moved off it
  std::int32_t source;  ///< the primitive
  bool inside;          ///< see Ray
};

Departure depart(const Surface& surface, Side side);

/// Marks a ray as leaving the surface: the solver then leaves out the root it starts from.
inline Ray from_surface(Ray ray, const Departure& departure) {
  ray.source = departure.source;
  ray.inside = departure.inside;
  return ray;
}

/// A ray that leaves the surface along `direction`, rounded to float once.
Ray leave(const Surface& surface, Side side, const Vec3d& direction);

/// A ray from the surface's viewer side that ends just before `light`.
Ray shadow_ray_to(const Surface& surface, const Vec3d& light);

/// A shadow ray as the lecture starts it (lecture "Shadow acne"), to be compared with the others:
/// at a point that floats have found, from `epsilon` units of length on, 0 or more, and without
/// knowing which primitive it leaves. Its direction and its end stay.
Ray start_by_epsilon(Ray shadow_ray, const Vec3f& point, float epsilon);

/// The point of a hit as a renderer finds it that computes in float: org + t dir, every operation
/// rounded.
Vec3f float_point(const Ray& ray, const Hit& hit);

}  // namespace boule
