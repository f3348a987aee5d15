#pragma once

#include "simd/kernel/search/leaf/ray_lanes.h"

/// Ray against sphere, lane by lane: a conservative reject in float, and the two solvers for the
/// spheres that pass it. The robust solver decides in double, exactly as core/reference.cpp does,
/// bit for bit; the fast one answers in float. docs/numerics.md derives the bound of the reject.
namespace boule::BOULE_KERNEL_ISA {

/// Spheres in lanes: the same one in all, for a packet, or W, for a single ray.
struct SphereLanes {
  Vec3<Real> center;
  Real radius;
  Bits id;
};

/// Below zero where a line certainly misses (filter_bounds.h): f = c - o, b = f.h.
BOULE_INLINE Real reject_sum(const Vec3<Real>& f, const Real& b, const Real& reject_squared) {
  const Real rest =
      filter_fnma(f.z, f.z, filter_fnma(f.y, f.y, filter_fnma(f.x, f.x, reject_squared)));
  return filter_fma(b, b, rest);
}

/// Lanes that certainly miss where every origin is a float: FilterRays::origins_exact.
BOULE_INLINE RealMask rejected_exact(const FilterRays& rays, const Vec3<Real>& center,
                                     const Real& reject_squared) {
  const Vec3<Real> f = center - rays.org;
  return reject_sum(f, filter_dot(f, rays.h), reject_squared) < Real(0.0F);
}
/// Lanes that certainly miss: the sphere grows by the rounding error of the origin.
BOULE_INLINE RealMask rejected(const FilterRays& rays, const Vec3<Real>& center,
                               const Real& reject_radius) {
  const Real grown = reject_radius + rays.origin_error;
  return rejected_exact(rays, center, grown * grown);
}

/// The radius for rejected() where it was not computed in advance.
BOULE_INLINE Real grown_on_the_spot(const Real& radius) {
  return filter_fma(abs(radius),
                    Real(static_cast<float>(1 + filter::slack_on_the_spot * filter::u)),
                    Real(static_cast<float>(2 * filter::floor)));
}

/// Where lines enter and leave spheres, if the discriminant is at least 0.
template <class W>
struct LineRootsOf {
  W enter, leave, discriminant;
  W r, b;  ///< the radius, and (c - o).d
};
using LineRoots = LineRootsOf<Wide>;

/// The roots of balls from their discriminants, r^2 - l.l: `f` leads from the origins to the
/// centres, b = f.d.
template <class Exact, class W>
BOULE_INLINE void find_roots(const Exact& rays, const Vec3<W>& f, const W& rr, const W& b,
                             const W& discriminant, W& enter, W& leave) {
  const W q = b + copysign(sqrt(rays.a * discriminant), b);
  const W from_a = q * rays.inverse_a;
  // A tangent line has the same root twice, and cc / q might be the quotient of two rounding
  // errors.
  const auto secant = W(0.0) < discriminant;
  const W from_cc = select(secant, (dot(f, f) - rr) / q, from_a);

  const auto ordered = from_cc < from_a;
  enter = select(ordered, from_cc, from_a);
  leave = select(ordered, from_a, from_cc);
}

/// Closest approach in double, never fused. core/reference.cpp derives the formula.
template <class Exact, class W>
BOULE_INLINE LineRootsOf<W> meet_lines(const Exact& rays, const Vec3<W>& center, const W& r) {
  const Vec3<W> f = center - rays.org;
  const W b = dot(f, rays.dir);
  const Vec3<W> l = f - rays.dir * (b * rays.inverse_a);
  const W rr = r * r;

  LineRootsOf<W> line;
  line.discriminant = rr - dot(l, l);
  line.r = r;
  line.b = b;
  find_roots(rays, f, rr, b, line.discriminant, line.enter, line.leave);
  return line;
}
BOULE_INLINE LineRoots meet_lines(const ExactRays& rays, const SphereLanes& sphere) {
  return meet_lines(rays, widen(sphere.center), widen(sphere.radius));
}

/// Solver robust.
BOULE_INLINE Roots solve_robust(const ExactRays& rays, const SphereLanes& sphere) {
  const LineRoots line = meet_lines(rays, sphere);
  Roots roots = first_in_range(line.enter, line.leave, rays);
  roots.hit = roots.hit & (Wide(0.0) <= line.discriminant);

  if (rays.has_source) {
    // The origin lies on the ray's own sphere, where cc = 0: from outside the ray does not hit it
    // again, from inside it does at 2b / a.
    const WideMask leaves = widen(rays.source == sphere.id);
    const Wide across = (line.b + line.b) * rays.inverse_a;
    const WideMask is_sphere = line.r == line.r;  // padding is not
    const WideMask again = rays.inside & is_sphere & in_range(across, rays);
    roots.t = select(leaves, across, roots.t);
    roots.hit = (leaves & again) | (~leaves & roots.hit);
  }
  return roots;
}

/// Solver fast: closest approach in float along the unit direction. For sizes from 1e-18 to
/// filter::limit it is wrong about hit or miss only within 3u max(F, r) of the rim, where F is the
/// distance of origin and centre. It misses larger spheres.
BOULE_INLINE Roots solve_fast(const RayLanes& rays, const SphereLanes& sphere) {
  const FilterRays& filter = rays.filter;
  const Vec3<Real> f = sphere.center - filter.org;
  const Vec3<Real>& h = filter.unit;
  const Real b = filter_dot(f, h);
  const Vec3<Real> l{filter_fnma(b, h.x, f.x), filter_fnma(b, h.y, f.y), filter_fnma(b, h.z, f.z)};
  const Real discriminant = filter_fma(sphere.radius, sphere.radius, Real(0.0F) - filter_dot(l, l));
  const Real half_chord = sqrt(discriminant);
  const Wide first = widen((b - half_chord) * filter.inverse_length);
  const Wide second = widen((b + half_chord) * filter.inverse_length);
  Roots roots = first_in_range(first, second, rays.exact);
  roots.hit = roots.hit & widen(Real(0.0F) <= discriminant);

  if (rays.exact.has_source) {
    const WideMask leaves = widen(rays.exact.source == sphere.id);
    const Wide across = widen((b + b) * filter.inverse_length);
    const WideMask is_sphere = widen(sphere.radius <= sphere.radius);
    const WideMask again = rays.exact.inside & is_sphere & in_range(across, rays.exact);
    roots.t = select(leaves, across, roots.t);
    roots.hit = (leaves & again) | (~leaves & roots.hit);
  }
  return roots;
}

}  // namespace boule::BOULE_KERNEL_ISA
