#pragma once

#include "simd/abi/bvh.h"
#include "simd/kernel/search/leaf/ray_lanes.h"

/// Rays against boxes, W rays against one or one ray against W. A box is the intersection of three
/// slabs, where a slab is the space between two parallel planes. The test rejects only certain
/// misses; docs/numerics.md derives its slack (filter::box, slab_least).
namespace boule::BOULE_KERNEL_ISA {

/// The distances at which rays cross the planes of an axis. A plane at x is crossed at t = x
/// inverse + near if it is the first of its slab, at x inverse + far if it is the second: `near` is
/// rounded down and `far` up. `farthest`: the tree ends before this distance.
template <class R>
struct SlabOf {
  R inverse, near, far;

  SlabOf() = default;
  template <class W>
  BOULE_INLINE SlabOf(const W& org, const R& unit, const R& farthest) {
    const R zero(0.0F), least(filter::slab_least), size = abs(unit);
    const auto tiny = size < least;
    const R steep = R(1.0F) / select(tiny, least, size);
    inverse = select(unit < zero, zero - steep, steep);
    const R aside = select(tiny, farthest * R(4 * filter::slab_least), zero);
    const W at = org * widen(inverse);
    const W slack = (widen(aside) + W(filter::floor)) * widen(steep);
    near = narrow(W(0.0) - at - slack);
    far = narrow(slack - at);
  }

  /// Reduces [begin, end] to the part between the first plane and the last. Rays that float cannot
  /// judge have NaN, which reduces nothing.
  BOULE_INLINE void cut(const Real& first, const Real& last, Real& begin, Real& end) const {
    begin = greater_or(filter_fma(first, inverse, near), begin);
    end = lesser_or(filter_fma(last, inverse, far), end);
  }
};
using Slab = SlabOf<Real>;

/// The slabs along the three axes. `extent`: BvhView::extent.
template <class Exact, class R, class W>
BOULE_INLINE Vec3<SlabOf<R>> slabs_of(const Exact& exact, const FilterOf<R, W>& filter,
                                      float extent) {
  const Vec3<R>& from = filter.org;
  const R farthest = abs(from.x) + abs(from.y) + abs(from.z) + R(extent);
  const Vec3<W>& org = exact.org;
  const Vec3<R>& unit = filter.unit;
  return {SlabOf<R>(org.x, unit.x, farthest), SlabOf<R>(org.y, unit.y, farthest),
          SlabOf<R>(org.z, unit.z, farthest)};
}

/// Rays for box tests.
struct BoxRays {
  Vec3<Slab> slabs;
  Real from;  ///< lower bound of t |dir| of valid hits; NaN: every box is entered

  BoxRays() = default;
  BOULE_INLINE BoxRays(const RayLanes& rays, float extent)
      : slabs(slabs_of(rays.exact, rays.filter, extent)),
        from(select(rays.filter.unit.x <= rays.filter.unit.x, rays.filter.dead_below,
                    rays.filter.unit.x)) {}
};

/// Boxes in lanes: the same one in all, for a packet, or W, for a single ray.
struct Boxes {
  Vec3<Real> min, max;
};

/// The distances at which rays enter boxes, and the lanes that certainly miss before a limit.
struct Entry {
  Real near;
  RealMask out;
};

/// Lanes in which an interval is certainly empty, whatever the rounding of its ends: empty by more
/// than 2 filter::box u of its begin. An interval whose begin is NaN counts as filled.
BOULE_INLINE RealMask is_empty(const Real& begin, const Real& end) {
  const Real slack(static_cast<float>(2 * filter::box * filter::u));
  return end < filter_fnma(abs(begin), slack, begin);
}

/// Enters boxes whose planes are sorted: rays cross `first` before `last`.
BOULE_INLINE Entry enter_ordered(const BoxRays& rays, const Vec3<Real>& first,
                                 const Vec3<Real>& last, const Real& limit) {
  Real near = rays.from, far = limit;
  rays.slabs.x.cut(first.x, last.x, near, far);
  rays.slabs.y.cut(first.y, last.y, near, far);
  rays.slabs.z.cut(first.z, last.z, near, far);
  return {near, is_empty(near, far)};
}

/// One ray's passage through W boxes: lower bounds of the entry distances, and the boxes that it
/// may enter.
struct Passage {
  Real near;
  RealMask in;
};

/// From the distances of the first and of the last planes. The ray has no hits behind its origin,
/// and float can judge it: comparisons with NaN reject.
BOULE_INLINE Passage pass_boxes(const Vec3<Real>& first, const Vec3<Real>& last,
                                const Real& reach) {
  const Real less(static_cast<float>(1 - 2 * filter::box * filter::u));
  const Real near =
      filter_max(filter_max(first.x, first.y), filter_max(first.z, Real(0.0F))) * less;
  const Real far = filter_min(filter_min(last.x, last.y), filter_min(last.z, reach));
  return {near, near <= far};
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
