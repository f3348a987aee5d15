#pragma once

#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::bench {

/// Where a ray of unit direction enters a capsule that has its first end at the origin, as shaders
/// solve it: the tube's quadratic, and where that is met beyond an end, the sphere's. `f`: the
/// ray's origin; NaN: a miss. Source: I. Quilez, https://iquilezles.org/articles/intersectors/
template <class Real>
Real book_capsule_entry(const Vec3<Real>& f, const Vec3<Real>& d, const Vec3<Real>& u, Real r) {
  const Real uu = dot(u, u), ud = dot(u, d), uf = dot(u, f), df = dot(d, f), ff = dot(f, f);
  const Real a = uu - ud * ud, b = uu * df - uf * ud;
  const Real c = uu * ff - uf * uf - r * r * uu, h = b * b - a * c;
  if (!(h >= 0)) return std::numeric_limits<Real>::quiet_NaN();
  const Real t = (-b - std::sqrt(h)) / a, along = uf + t * ud;
  if (along > 0 && along < uu) return t;
  const Vec3<Real> from = along <= 0 ? f : f - u;
  const Real half_b = dot(d, from);
  return -half_b - std::sqrt(half_b * half_b - (dot(from, from) - r * r));
}

/// The nearest t > 0 in units of the ray's direction; infinity: a miss. The exit is the entry of
/// the ray that comes the other way. Real: float or double.
template <class Real>
double book_capsule(const Ray& ray, const Capsule& capsule) {
  const Vec3<Real> a = vec_cast<Real>(capsule.a), f = vec_cast<Real>(ray.org) - a;
  const Vec3<Real> u = vec_cast<Real>(capsule.b) - a, dir = vec_cast<Real>(ray.dir);
  const Real speed = std::sqrt(dot(dir, dir)), r = capsule.radius;
  const Vec3<Real> d = dir * (1 / speed);
  const Real entry = book_capsule_entry(f, d, u, r);
  if (entry > 0) return entry / speed;
  const Real exit = -book_capsule_entry(f, d * Real{-1}, u, r);
  return exit > 0 ? exit / speed : std::numeric_limits<double>::infinity();
}

}  // namespace boule::bench
