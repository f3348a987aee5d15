#pragma once

#include "simd/abi/geometry.h"
#include "simd/kernel/packet.h"

/// Ray against plane, lane by lane: t = ((p0 - o).n) / (d.n).
namespace boule::BOULE_KERNEL_ISA {

struct PlaneLanes {
  Vec3<Real> point, normal;
  Wide id;
};

/// Solver robust: in double, never fused; products of two floats are exact in it.
BOULE_INLINE Roots solve_robust(const ExactRays& rays, const PlaneLanes& plane) {
  const Vec3<Wide> n = widen(plane.normal);
  const Wide along = dot(rays.dir, n);
  const Wide t = dot(widen(plane.point) - rays.org, n) / along;
  const Wide infinite(no_hit);
  const WideMask crosses = (Wide(0.0) < abs(along)) & (abs(along) < infinite);
  const WideMask leaves = rays.source == plane.id;
  return {t, crosses & ~leaves & in_range(t, rays)};
}

/// Solver fast: the same in float, along the unit direction; a nearly parallel plane makes it
/// wrong.
BOULE_INLINE Roots solve_fast(const RayLanes& rays, const PlaneLanes& plane) {
  const Vec3<Real>&n = plane.normal, &h = rays.filter.unit;
  const Vec3<Real> f = plane.point - rays.filter.org;
  const Real along = filter_dot(h, n);
  const Real height = filter_dot(f, n);
  const Wide t = widen(height / along * rays.filter.inverse_length);
  const WideMask crosses = widen(Real(0.0F) < abs(along));
  const WideMask leaves = rays.exact.source == plane.id;
  return {t, crosses & ~leaves & in_range(t, rays.exact)};
}

}  // namespace boule::BOULE_KERNEL_ISA
