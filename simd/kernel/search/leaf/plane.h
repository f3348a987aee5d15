#pragma once

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/ray_lanes.h"

/// Ray against plane, lane by lane: t = ((p0 - o).n) / (d.n). Planes have no reject, because scenes
/// have few of them.
namespace boule::BOULE_KERNEL_ISA {

struct PlaneLanes {
  Vec3<Real> point, normal;
  Bits id;
};

/// The rounding error of a + b, exactly; `sum` is the rounded sum.
BOULE_INLINE Wide lost(const Wide& a, const Wide& b, const Wide& sum) {
  const Wide b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part);
}

/// d.n for vectors of floats, summed almost exactly: products of floats are exact in double, and
/// the rounding errors of the two sums are added at the end. core/reference.cpp gives the reason.
BOULE_INLINE Wide exact_dot(const Vec3<Wide>& d, const Vec3<Wide>& n) {
  const Wide x = d.x * n.x, y = d.y * n.y, z = d.z * n.z;
  const Wide xy = x + y, sum = xy + z;
  return sum + (lost(x, y, xy) + lost(xy, z, sum));
}

/// Solver robust: in double, never fused.
BOULE_INLINE Roots solve_robust(const ExactRays& rays, const PlaneLanes& plane) {
  const Vec3<Wide> n = widen(plane.normal);
  const Wide along = exact_dot(rays.dir, n);
  const Wide t = dot(widen(plane.point) - rays.org, n) / along;
  const Wide infinite(no_hit);
  const WideMask crosses = (Wide(0.0) < abs(along)) & (abs(along) < infinite);
  const WideMask leaves = widen(rays.source == plane.id);
  return {t, crosses & ~leaves & in_range(t, rays)};
}

/// Solver fast: the same in float, along the unit direction. It is wrong about planes that are
/// nearly parallel to the ray.
BOULE_INLINE Roots solve_fast(const RayLanes& rays, const PlaneLanes& plane) {
  const Vec3<Real>&n = plane.normal, &h = rays.filter.unit;
  const Vec3<Real> f = plane.point - rays.filter.org;
  const Real along = filter_dot(h, n);
  const Real height = filter_dot(f, n);
  const Wide t = widen(height / along * rays.filter.inverse_length);
  const WideMask crosses = widen(Real(0.0F) < abs(along));
  const WideMask leaves = widen(rays.exact.source == plane.id);
  return {t, crosses & ~leaves & in_range(t, rays.exact)};
}

}  // namespace boule::BOULE_KERNEL_ISA
