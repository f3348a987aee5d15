#pragma once

#include <limits>

#include "core/math/geometry.h"
#include "core/math/number.h"

namespace boule {

/// What follows from where a ray met a sphere or a plane, as formulas for doubles and for lanes of
/// them: see Surface. They take any numbers; those that are not finite make such numbers.

/// A ray that met something.
template <class T>
struct ArrivalOf {
  Vec3<T> org, dir;
  Vec3<T> point;           ///< org + t dir
  Mask<T> leaves_it;       ///< the ray starts on the primitive that it meets
  Mask<T> is_from_origin;  ///< its tmin is 0
};

/// The surface where a ray arrived.
template <class T>
struct ContactOf {
  Vec3<T> outward;  ///< geometric normal, of unit length, or not finite
  T reach;          ///< what the error of the point is relative to
  Mask<T> inner;    ///< on the sphere's inside, or on the plane's back
};

template <class T>
BOULE_INLINE ContactOf<T> meet_sphere(const ArrivalOf<T>& ray, const Vec3<T>& center,
                                      const T& radius) {
  const Vec3<T> f = center - ray.org, outward = ray.point - center;
  const T ff = dot(f, f);
  // Which side is met follows from where the ray started, not from the angle: the solver took the
  // second root for the same sign of the same expression, so a grazing ray cannot change sides. A
  // ray that begins elsewhere than at its origin may meet the other root: there the angle tells.
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

/// A sphere, or a plane.
template <class T>
struct PrimitiveOf {
  Mask<T> plane;      ///< it is a plane
  Vec3<T> place;      ///< the sphere's centre, or the plane's point
  T radius;           ///< of a sphere
  Vec3<T> normal;     ///< of a plane
  Vec3<T> direction;  ///< normalize(normal), of a plane
};

/// meet_plane() or meet_sphere(). Both need the distance of `place`, which is found once.
template <class T>
BOULE_INLINE ContactOf<T> meet_primitive(const ArrivalOf<T>& ray, const PrimitiveOf<T>& met) {
  const ContactOf<T> sphere = meet_sphere(ray, met.place, met.radius);
  const T away = length(met.place - ray.org) + length(ray.point - ray.org);
  return {select(met.plane, met.direction, sphere.outward), select(met.plane, away, sphere.reach),
          select(met.plane, T(0.0) < dot(ray.dir, met.normal), sphere.inner)};
}

/// The normal on the side that a ray came from; not finite where `outward` is not.
template <class T>
BOULE_INLINE Vec3<T> turned_normal(const ContactOf<T>& contact) {
  return contact.outward * select(contact.inner, T(-1.0), T(1.0));
}

/// True if no component is NaN or infinite.
template <class T>
BOULE_INLINE Mask<T> all_finite(const Vec3<T>& v) {
  const T largest(std::numeric_limits<double>::max());
  const Mask<T> x = abs(v.x) <= largest, y = abs(v.y) <= largest, z = abs(v.z) <= largest;
  return x & y & z;
}

/// The unit normal on the side that a ray came from; `view` is the ray's unit direction.
template <class T>
BOULE_INLINE Vec3<T> facing_normal(const ContactOf<T>& contact, const Vec3<T>& view) {
  const Vec3<T> turned = turned_normal(contact);
  // Of a sphere that is too small for its distance from (0, 0, 0) the point is the centre. Any
  // normal is right then; this one faces the ray.
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

/// A hit's point is known to this share of the distances that made it (ContactOf::reach), axis by
/// axis.
inline constexpr double point_error = 0x1p-49;

/// The point, moved along a unit normal until it is certainly on that side of the surface.
template <class T>
BOULE_INLINE Vec3<T> move_off(const Vec3<T>& point, const Vec3<T>& normal, const T& reach) {
  return point +
         normal * ((abs(normal.x) + abs(normal.y) + abs(normal.z)) * T(point_error) * reach);
}

}  // namespace boule
