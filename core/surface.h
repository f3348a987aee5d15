#pragma once

#include <cstdint>
#include <span>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule {

/// The surface at which a ray hit a primitive, all in double; core/optics/incidence.h has the
/// formulas. A ray that leaves it starts at the hit point moved off the surface by a bound of its
/// error, without an epsilon (lecture "Shadow acne"). The functions throw nothing; numbers that are
/// not finite give such numbers.
struct Surface {
  Vec3d point;      ///< org + t dir
  Vec3d normal;     ///< geometric, unit length, turned towards the viewer
  Vec3d view;       ///< the ray's direction V, unit length
  Vec3d mirrored;   ///< R = V - 2 (N.V) N (lecture "Reflection"), unit length
  double cosine;    ///< -N.V, in [0, 1]
  double reach;     ///< the error of `point` is relative to this: F + r (capsule: F + length + r)
  std::int32_t id;  ///< the primitive
  bool inner;       ///< hit on the inside of a sphere or capsule, or on the plane's back
  bool solid;       ///< of a sphere or capsule
};

/// The side to which a ray leaves a surface: the viewer's side, or beyond.
enum class Side { viewer, beyond };

/// The surface of the primitive that a ray hit. Precondition: `hit` is a hit of this ray, not a
/// miss.
Surface find_surface(const Sphere& sphere, const Ray& ray, const Hit& hit);
Surface find_surface(const Plane& plane, const Ray& ray, const Hit& hit);
Surface find_surface(const Capsule& capsule, const Ray& ray, const Hit& hit);

/// The same among these primitives, by id: the spheres, then the planes. Precondition, unchecked:
/// the id exists.
Surface find_surface(std::span<const Sphere> spheres, std::span<const Plane> planes, const Ray& ray,
                     const Hit& hit);

/// Surface::normal by itself.
Vec3d find_normal(const Sphere& sphere, const Ray& ray, const Hit& hit);
Vec3d find_normal(const Plane& plane, const Ray& ray, const Hit& hit);
Vec3d find_normal(const Capsule& capsule, const Ray& ray, const Hit& hit);

/// The start of a ray that leaves the surface, with the source for the solver.
struct Departure {
  Vec3d org;            ///< the surface's point, moved off it
  std::int32_t source;  ///< the primitive
  bool inside;          ///< see Ray
};

Departure depart(const Surface& surface, Side side);

/// Marks a ray as leaving the surface: the solver then excludes the root at its start.
inline Ray from_surface(Ray ray, const Departure& departure) {
  ray.source = departure.source;
  ray.inside = departure.inside;
  return ray;
}

/// A ray that leaves the surface along `direction`, rounded to float once.
Ray leave(const Surface& surface, Side side, const Vec3d& direction);

/// A ray from the surface's viewer side that ends just before `light`.
Ray shadow_ray_to(const Surface& surface, const Vec3d& light);

/// A shadow ray as the lecture starts it (lecture "Shadow acne"), for comparison: at a point found
/// in floats, from `epsilon` units of length on, 0 or more, without its source primitive. Its
/// direction and its end stay.
Ray start_by_epsilon(Ray shadow_ray, const Vec3f& point, float epsilon);

/// The point of a hit as computed by a renderer in float: org + t dir, every operation rounded.
Vec3f float_point(const Ray& ray, const Hit& hit);

}  // namespace boule
