#pragma once

#include "simd/abi/bvh.h"
#include "simd/kernel/search/ray_lanes.h"

/// Rays against boxes: a box is what three slabs, the spaces between two planes, have in common.
namespace boule::BOULE_KERNEL_ISA {

/// Where rays meet the planes of an axis: t = x inverse + near for the planes met first, x inverse
/// + far for the others, a little outward (filter_bounds.h, slab_least). `farthest`: the tree ends
/// before this distance.
struct Slab {
  Real inverse, near, far;

  BOULE_INLINE Slab(const Wide& org, const Real& unit, const Real& farthest) {
    const Real zero(0.0F), least(filter::slab_least), size = abs(unit);
    const RealMask tiny = size < least;
    const Real steep = Real(1.0F) / select(tiny, least, size);
    inverse = select(unit < zero, zero - steep, steep);
    const Real aside = select(tiny, farthest * Real(4 * filter::slab_least), zero);
    const Wide at = org * widen(inverse);
    const Wide slack = (widen(aside) + Wide(filter::floor)) * widen(steep);
    near = narrow(Wide(0.0) - at - slack);
    far = narrow(slack - at);
  }

  /// [begin, end] cut to what lies between the plane that is met first and the other one. NaN, of a
  /// ray that the filter cannot judge, cuts nothing.
  BOULE_INLINE void cut(const Real& first, const Real& last, Real& begin, Real& end) const {
    begin = greater_or(filter_fma(first, inverse, near), begin);
    end = lesser_or(filter_fma(last, inverse, far), end);
  }
};

/// The slabs of a packet's rays, or of one ray in every lane.
BOULE_INLINE Vec3<Slab> slabs_of(const RayLanes& rays, float extent) {
  const Vec3<Real>& from = rays.filter.org;
  const Real farthest = abs(from.x) + abs(from.y) + abs(from.z) + Real(extent);
  const Vec3<Wide>& org = rays.exact.org;
  const Vec3<Real>& unit = rays.filter.unit;
  return {Slab(org.x, unit.x, farthest), Slab(org.y, unit.y, farthest),
          Slab(org.z, unit.z, farthest)};
}

/// Rays as box tests see them.
struct BoxRays {
  Vec3<Slab> slabs;
  Real from;  ///< nothing is live below this t |dir|; NaN: every box is entered

  BOULE_INLINE BoxRays(const RayLanes& rays, float extent)
      : slabs(slabs_of(rays, extent)),
        from(select(rays.filter.unit.x <= rays.filter.unit.x, rays.filter.dead_below,
                    rays.filter.unit.x)) {}
};

/// Boxes in lanes: one for a packet, or several for a ray.
struct Boxes {
  Vec3<Real> min, max;
};

/// Where rays enter boxes, and the lanes in which they certainly do not before a limit.
struct Entry {
  Real near;
  RealMask out;
};

/// Lanes in which an interval is certainly empty: 2 filter::box u of its begin are for the
/// rounding of both ends. None where the begin is NaN.
BOULE_INLINE RealMask is_empty(const Real& begin, const Real& end) {
  const Real slack(static_cast<float>(2 * filter::box * filter::u));
  return end < filter_fnma(abs(begin), slack, begin);
}

/// For rays that all go up, or down, along each axis: `first` and `last` are the planes that they
/// meet first, and the others.
BOULE_INLINE Entry enter_ordered(const BoxRays& rays, const Vec3<Real>& first,
                                 const Vec3<Real>& last, const Real& limit) {
  Real near = rays.from, far = limit;
  rays.slabs.x.cut(first.x, last.x, near, far);
  rays.slabs.y.cut(first.y, last.y, near, far);
  rays.slabs.z.cut(first.z, last.z, near, far);
  return {near, is_empty(near, far)};
}

BOULE_INLINE Entry enter_boxes(const BoxRays& rays, const Boxes& boxes, const Real& limit) {
  const Real zero(0.0F);
  const RealMask x = rays.slabs.x.inverse < zero, y = rays.slabs.y.inverse < zero,
                 z = rays.slabs.z.inverse < zero;
  const auto& [min, max] = boxes;
  return enter_ordered(
      rays, {select(x, max.x, min.x), select(y, max.y, min.y), select(z, max.z, min.z)},
      {select(x, min.x, max.x), select(y, min.y, max.y), select(z, min.z, max.z)}, limit);
}

}  // namespace boule::BOULE_KERNEL_ISA
