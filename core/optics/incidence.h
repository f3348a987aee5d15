#pragma once

#include <limits>

#include "core/math/geometry.h"
#include "core/math/number.h"

namespace boule {

/// The geometry of hits with spheres, planes and capsules, as formulas for doubles and for lanes of
/// them: see Surface. They take any numbers; numbers that are not finite give such numbers.

/// A ray that hit a primitive.
template <class T>
struct ArrivalOf {
  Vec3<T> org, dir;
  Vec3<T> point;           ///< org + t dir
  Mask<T> leaves_it;       ///< the ray starts on the primitive that it hits
  Mask<T> is_from_origin;  ///< its tmin is 0
};

/// The surface at which a ray arrived.
template <class T>
struct ContactOf {
  Vec3<T> outward;  ///< geometric normal, of unit length, or not finite
  T reach;          ///< the error of the point is relative to this
  Mask<T> inner;    ///< on the inside of a sphere or capsule, or on the plane's back
};

template <class T>
BOULE_INLINE ContactOf<T> meet_sphere(const ArrivalOf<T>& ray, const Vec3<T>& center,
                                      const T& radius) {
  const Vec3<T> f = center - ray.org, outward = ray.point - center;
  const T ff = dot(f, f);
  // The ray's start decides which side it hits, rather than the angle: the solver took the second
  // root by the same sign of the same expression, so a grazing ray cannot change sides. A ray whose
  // interval begins away from its origin may hit the other root: there the angle decides.
  const Mask<T> starts_inside = ray.leaves_it | (ff - radius * radius <= T(0.0));
  const Mask<T> goes_out = T(0.0) < dot(outward, ray.dir);
  return {normalize(outward), sqrt(ff) + radius,
          select(ray.is_from_origin, starts_inside, goes_out)};
}

template <class T>
BOULE_INLINE ContactOf<T> meet_plane(const ArrivalOf<T>& ray, const Vec3<T>& point,
                                     const Vec3<T>& normal) {
  // The plane's own point may lie near the eye while the hit is far away: both count.
  return {normalize(normal), length(point - ray.org) + length(ray.point - ray.org),
          T(0.0) < dot(ray.dir, normal)};
}

/// The point of the segment a + s u, 0 <= s <= 1, that is nearest to `point`.
template <class T>
BOULE_INLINE Vec3<T> nearest_on_segment(const Vec3<T>& a, const Vec3<T>& u, const Vec3<T>& point) {
  const T s = dot(point - a, u) / dot(u, u);
  // NaN, as of a segment without length, becomes 0.
  return a + u * select(T(0.0) < s, select(s < T(1.0), s, T(1.0)), T(0.0));
}

/// A capsule around the segment from a to a + u. A ray meets it where it meets the ball around the
/// point of the segment that is nearest.
template <class T>
BOULE_INLINE ContactOf<T> meet_capsule(const ArrivalOf<T>& ray, const Vec3<T>& a, const Vec3<T>& u,
                                       const T& radius) {
  const Vec3<T> outward = ray.point - nearest_on_segment(a, u, ray.point);
  const Vec3<T> start = ray.org - nearest_on_segment(a, u, ray.org);
  const Mask<T> starts_inside = ray.leaves_it | (dot(start, start) - radius * radius <= T(0.0));
  const Mask<T> goes_out = T(0.0) < dot(outward, ray.dir);
  return {normalize(outward), length(a - ray.org) + length(u) + radius,
          select(ray.is_from_origin, starts_inside, goes_out)};
}

/// A sphere, or a plane.
template <class T>
struct PrimitiveOf {
  Mask<T> plane;      ///< it is a plane
  Vec3<T> place;      ///< the sphere's centre, or the plane's point
  T radius;           ///< of a sphere
  Vec3<T> normal;     ///< of a plane
  Vec3<T> direction;  ///< normalize(normal), of a plane
};

/// meet_plane() or meet_sphere(). Both need the distance of `place`, which is computed once.
template <class T>
BOULE_INLINE ContactOf<T> meet_primitive(const ArrivalOf<T>& ray, const PrimitiveOf<T>& met) {
  const ContactOf<T> sphere = meet_sphere(ray, met.place, met.radius);
  const T away = length(met.place - ray.org) + length(ray.point - ray.org);
  return {select(met.plane, met.direction, sphere.outward), select(met.plane, away, sphere.reach),
          select(met.plane, T(0.0) < dot(ray.dir, met.normal), sphere.inner)};
}

/// The normal on the side from which a ray came; not finite if `outward` is not.
template <class T>
BOULE_INLINE Vec3<T> turned_normal(const ContactOf<T>& contact) {
  return contact.outward * select(contact.inner, T(-1.0), T(1.0));
}

/// True if every component is finite.
template <class T>
BOULE_INLINE Mask<T> all_finite(const Vec3<T>& v) {
  const T largest(std::numeric_limits<double>::max());
  const Mask<T> x = abs(v.x) <= largest, y = abs(v.y) <= largest, z = abs(v.z) <= largest;
  return x & y & z;
}

/// The unit normal on the side from which a ray came; `view` is the ray's unit direction.
template <class T>
BOULE_INLINE Vec3<T> facing_normal(const ContactOf<T>& contact, const Vec3<T>& view) {
  const Vec3<T> turned = turned_normal(contact);
  // For a sphere that is too small for its distance from (0, 0, 0), the point equals the centre.
  // Any normal is right then; this one faces the ray.
  return select(all_finite(turned), turned, view * T(-1.0));
}

/// -N.V, in [0, 1].
template <class T>
BOULE_INLINE T facing_cosine(const Vec3<T>& normal, const Vec3<T>& view) {
  const T cosine = dot(normal, view) * T(-1.0);
  return select(cosine < T(0.0), T(0.0), select(T(1.0) < cosine, T(1.0), cosine));
}

/// V - 2 (N.V) N (lecture "Reflection"), with the cosine -N.V.
template <class T>
BOULE_INLINE Vec3<T> mirror(const Vec3<T>& view, const Vec3<T>& normal, const T& cosine) {
  return view + normal * (T(2.0) * cosine);
}

/// The error of a hit's point as a fraction of the distances it was computed from
/// (ContactOf::reach), axis by axis.
inline constexpr double point_error = 0x1p-49;

/// The point, moved along a unit normal until it is certainly on that side of the surface.
template <class T>
BOULE_INLINE Vec3<T> move_off(const Vec3<T>& point, const Vec3<T>& normal, const T& reach) {
  return point +
         normal * ((abs(normal.x) + abs(normal.y) + abs(normal.z)) * T(point_error) * reach);
}

}  // namespace boule
