#pragma once

#include <limits>

#include "simd/kernel/search/leaf/sphere.h"

/// The certain knowledge of float about a sphere that passed the reject: bounds of its two roots.
/// With them most spheres need no double solve, because another one is certainly nearer.
/// docs/numerics.md derives the bounds (filter::spread).
namespace boule::BOULE_KERNEL_ISA {

/// Bounds of both roots, as distances t |dir|. Where float is undecided they are NaN: comparisons
/// with NaN are false, so they decide nothing.
struct RootBounds {
  Real first_low, first_high, second_low, second_high;
  RealMask certain;  ///< the line certainly meets the sphere, and all four bounds hold
  RealMask misses;   ///< the line certainly misses it
};

/// Bound of the errors of b and l (filter_bounds.h) for a sphere that may be hit.
BOULE_INLINE Real root_spread(const FilterRays& rays, const Real& b, const Real& r) {
  constexpr auto unit_spread = static_cast<float>(filter::spread * filter::u);
  return filter_fma(abs(b) + (r + r), Real(unit_spread), rays.origin_error);
}

/// A number below both roots that needs no square root: sqrt(r^2 + doubt) is at most r + 2 spread,
/// because spread is at least 14 u r.
BOULE_INLINE Real before_roots(const FilterRays& rays, const Vec3<Real>& center,
                               const Real& signed_radius) {
  const Real b = filter_dot(center - rays.org, rays.unit), r = abs(signed_radius);
  return b - r - Real(4.0F) * root_spread(rays, b, r);
}

/// The position of a line relative to a sphere; the roots follow from it.
struct Approach {
  Real along;         ///< b, the point of the line nearest to the centre
  Real discriminant;  ///< of the roots; its error is below `doubt`
  Real spread;        ///< bound of the error of b and l
  Real doubt;
};

BOULE_INLINE Approach find_approach(const FilterRays& rays, const Vec3<Real>& center,
                                    const Real& signed_radius) {
  constexpr auto unit_spread = static_cast<float>(filter::spread * filter::u);
  const Vec3<Real> f = center - rays.org;
  const Real b = filter_dot(f, rays.unit), r = abs(signed_radius);
  const Vec3<Real> l{filter_fnma(b, rays.unit.x, f.x), filter_fnma(b, rays.unit.y, f.y),
                     filter_fnma(b, rays.unit.z, f.z)};
  const Real square = r * r, spread = root_spread(rays, b, r);
  const Real discriminant =
      filter_fnma(l.z, l.z, filter_fnma(l.y, l.y, filter_fnma(l.x, l.x, square)));
  const Real width_doubt = spread * filter_fma(spread, Real(3.0F), r + r);
  return {b, discriminant, spread, filter_fma(square, Real(unit_spread), width_doubt)};
}

/// Lanes that may have a root between 0 and `reach`, found without a square root as in
/// before_roots().
BOULE_INLINE RealMask may_meet(const Approach& approach, const Real& signed_radius,
                               const Real& reach) {
  const auto& [b, discriminant, spread, doubt] = approach;
  const Real most = filter_fma(Real(4.0F), spread, abs(signed_radius));
  return (Real(0.0F) <= discriminant + doubt) & (Real(0.0F) <= b + most) & (b - most <= reach);
}

/// The same with the reject in place of the discriminant: it lets a few more through, in three
/// quarters of the steps. Its b has a larger error, which docs/numerics.md bounds and 4 spread
/// cover. The object holds the part that depends on the spheres alone.
class RejectSpheres {
 public:
  BOULE_INLINE RejectSpheres(const Vec3<Real>& center, const Real& signed_radius)
      : center_(center),
        grown_(grown_on_the_spot(signed_radius)),
        most_(abs(signed_radius) * Real(outward)) {}
  /// Lanes that may have a root between 0 and `reach`. `h`, `origin_error`: as in FilterRays.
  [[nodiscard]] BOULE_INLINE RealMask may_meet(const Vec3<Real>& org, const Vec3<Real>& h,
                                               const Real& origin_error, const Real& reach) const {
    const Vec3<Real> f = center_ - org;
    const Real b = filter_dot(f, h);
    const Real edge = grown_ + origin_error;
    const Real most =
        filter_fma(Real(4.0F), origin_error, filter_fma(abs(b), Real(four_spreads), most_));
    return (Real(0.0F) <= reject_sum(f, b, edge * edge)) & (Real(0.0F) <= b + most) &
           (b - most <= reach);
  }

 private:
  static constexpr auto four_spreads = static_cast<float>(4 * filter::spread * filter::u);
  static constexpr auto outward = static_cast<float>(1 + 8 * filter::spread * filter::u);

  Vec3<Real> center_;
  Real grown_, most_;
};

BOULE_INLINE RootBounds bound_roots(const Approach& approach) {
  const auto& [b, discriminant, spread, doubt] = approach;
  RootBounds bounds;
  const Real largest(std::numeric_limits<float>::max());
  bounds.certain = doubt < discriminant;
  // Beyond filter::limit l.l may overflow, and an infinite number decides nothing.
  bounds.misses = (Real(0.0F) - largest <= discriminant) & (discriminant + doubt < Real(0.0F));
  const Real least = sqrt(discriminant - doubt), most = sqrt(discriminant + doubt);
  bounds.first_low = b - spread - most;
  bounds.first_high = b + spread - least;
  bounds.second_low = b - spread + least;
  bounds.second_high = b + spread + most;
  return bounds;
}

/// Lower bound of the root that may be the hit: the second one where the first is behind the ray.
BOULE_INLINE Real lowest(const RootBounds& roots, const FilterRays& rays) {
  return select(roots.first_high < rays.dead_below, roots.second_low, roots.first_low);
}

/// Lanes that certainly have no valid root.
BOULE_INLINE RealMask dead(const RootBounds& roots, const FilterRays& rays) {
  return roots.misses | (roots.second_high < rays.dead_below);
}

/// Upper bound of the first valid root; inf where float is uncertain that there is one.
BOULE_INLINE Real highest(const RootBounds& roots, const FilterRays& rays) {
  const Real none(static_cast<float>(no_hit));
  const Real second = select(rays.live_from < roots.second_low, roots.second_high, none);
  const Real first = select(rays.live_from < roots.first_low, roots.first_high, second);
  return select(roots.certain, first, none);
}

/// Lanes that certainly have a valid root.
BOULE_INLINE RealMask live(const RootBounds& roots, const FilterRays& rays) {
  const RealMask first = (rays.live_from < roots.first_low) & (roots.first_high <= rays.live_to);
  const RealMask second = (rays.live_from < roots.second_low) & (roots.second_high <= rays.live_to);
  return roots.certain & (first | second);
}

}  // namespace boule::BOULE_KERNEL_ISA
