#pragma once

#include "simd/abi/capsules.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/search/leaf/sphere.h"

/// Ray against capsule, lane by lane: certain knowledge in float, and the solver in double, as
/// core/reference.cpp does it, bit for bit. docs/numerics.md derives the bounds.
namespace boule::BOULE_KERNEL_ISA {

/// Capsules in lanes: the same one in all, for a packet, or W, for a single ray.
struct CapsuleLanes {
  Vec3<Real> a, b;
  Real radius;
  Bits id;
};

/// The capsules in W slots.
BOULE_INLINE CapsuleLanes gather_capsules(const CapsuleView& capsules, const std::uint32_t* slots) {
  alignas(64) float numbers[7][width];
  alignas(64) std::int32_t id[width];
  for (int lane = 0; lane < width; ++lane) {
    const CapsuleBlock& block = capsules.blocks[slots[lane] / bvh_leaf_size];
    const std::size_t k = slots[lane] % bvh_leaf_size;
    const float* const rows[] = {block.a_x, block.a_y, block.a_z,   block.b_x,
                                 block.b_y, block.b_z, block.radius};
    for (int i = 0; i < 7; ++i) numbers[i][lane] = rows[i][k];
    id[lane] = capsules.id[slots[lane]];
  }
  return {{load(numbers[0]), load(numbers[1]), load(numbers[2])},
          {load(numbers[3]), load(numbers[4]), load(numbers[5])},
          load(numbers[6]),
          load_integers(id)};
}

/// The capsules of a block, step by step.
template <class Access>
struct BlockCapsules {
  const CapsuleBlock& block;
  const std::int32_t* ids;
  std::size_t first_slot;

  [[nodiscard]] BOULE_INLINE CapsuleLanes get(std::size_t step) const {
    return {
        {Access::get(block.a_x, step), Access::get(block.a_y, step), Access::get(block.a_z, step)},
        {Access::get(block.b_x, step), Access::get(block.b_y, step), Access::get(block.b_z, step)},
        Access::get(block.radius, step),
        Access::get(ids, step)};
  }
  [[nodiscard]] BOULE_INLINE Bits slot(std::size_t step) const {
    return Access::indices(first_slot, step);
  }
};

/// The fraction of the radius by which a capsule that is certainly hit may be too large.
inline constexpr auto shrinking = static_cast<float>(filter::slack_on_the_spot * filter::u);

/// A number in lanes moved to the range 0 .. 1; NaN becomes 0.
template <class Number>
BOULE_INLINE Number on_segment(const Number& s) {
  const Number zero(0), one(1);
  return select(zero < s, select(s < one, s, one), zero);
}

/// The certain knowledge of float about capsules: lanes that miss; lanes whose line hits; and
/// bounds of the t |dir| at which such a line enters. NaN decides nothing.
struct CapsuleBounds {
  RealMask out, certain;
  Real low, high;
};

/// From the distance of the ray's line from the segment.
BOULE_INLINE CapsuleBounds bound_capsule(const FilterRays& rays, const CapsuleLanes& capsule) {
  const Vec3<Real> f = capsule.a - rays.org, u = capsule.b - capsule.a;
  const Vec3<Real>& d = rays.unit;
  const auto across = [&](const Vec3<Real>& w, const Real& along) {
    return Vec3<Real>{filter_fnma(along, d.x, w.x), filter_fnma(along, d.y, w.y),
                      filter_fnma(along, d.z, w.z)};
  };
  const Real zero(0.0F), b = filter_dot(f, d), e = filter_dot(u, d);
  const Vec3<Real> l = across(f, b), v = across(u, e);
  const Real vv = filter_dot(v, v), inverse_vv = Real(1.0F) / vv;
  const Real nearest = (zero - filter_dot(l, v)) * inverse_vv, s = on_segment(nearest);
  const Vec3<Real> closest{filter_fma(v.x, s, l.x), filter_fma(v.y, s, l.y),
                           filter_fma(v.z, s, l.z)};
  const Real square = filter_dot(closest, closest);
  const Real error = filter_fma(Real(static_cast<float>(filter::capsule * filter::u)),
                                sum_abs(f) + sum_abs(u), rays.origin_error);
  const Real grown = grown_on_the_spot(capsule.radius) + error;
  const Real shrunk =
      filter_fnma(abs(capsule.radius), Real(shrinking), abs(capsule.radius)) - error;
  // The ball that is entered first is hit: the part of the segment near the line.
  const Real part = grown * sqrt(vv) * inverse_vv;
  const Real one(1.0F);  // NaN, where v is 0, becomes the end of the segment that comes first
  const Real first =
      select(e < zero, one - on_segment(one - (nearest + part)), on_segment(nearest - part));
  return {grown * grown < square, (zero < shrunk) & (square < shrunk * shrunk),
          filter_fma(e, first, b) - grown, filter_fma(e, s, b) + error};
}

/// Where lines enter and leave capsules, in the lanes that are met.
struct CapsuleRoots {
  Wide enter, leave;
  WideMask met;
};

/// The balls of a capsule, and the rays.
struct Balls {
  const ExactRays& rays;
  Vec3<Wide> f, u;  ///< a - org, b - a
  Wide rr;          ///< the radius, squared

  /// The line in the ball at s of the segment, which it hits, perhaps but for rounding.
  BOULE_INLINE void meet(const Wide& s, Wide& enter, Wide& leave) const {
    const Wide zero(0.0);
    const Vec3<Wide> g = f + u * s;
    const Wide b = dot(g, rays.dir);
    const Vec3<Wide> l = g - rays.dir * (b * rays.inverse_a);
    const Wide found = rr - dot(l, l), discriminant = select(found < zero, zero, found);
    find_roots(rays, g, rr, b, discriminant, enter, leave);
  }
};

/// Solver robust, in double, never fused. core/reference.cpp derives the formula.
BOULE_INLINE CapsuleRoots meet_lines(const ExactRays& rays, const CapsuleLanes& capsule) {
  const Wide zero(0.0), r = widen(capsule.radius);
  const Vec3<Wide> a = widen(capsule.a);
  const Balls balls{rays, a - rays.org, widen(capsule.b) - a, r * r};
  const auto& d = rays.dir;
  const Wide along = dot(balls.u, d);
  const Vec3<Wide> l = balls.f - d * (dot(balls.f, d) * rays.inverse_a);
  const Vec3<Wide> v = balls.u - d * (along * rays.inverse_a);
  const Wide vv = dot(v, v);
  const WideMask slanted = zero < vv;
  const Wide nearest = select(slanted, dot(l, v) * Wide(-1.0) / vv, zero);
  const Vec3<Wide> closest = l + v * on_segment(nearest), off_axis = l + v * nearest;
  const Wide found = balls.rr - dot(off_axis, off_axis);
  const Wide h = sqrt(select(found < zero, zero, found));
  const Wide size = sqrt(dot(balls.u, balls.u) * vv) * sqrt(rays.a);
  const Wide lean = select(slanted, h * along / size, copysign(Wide(no_hit), along));

  CapsuleRoots roots;
  Wide unused;
  balls.meet(on_segment(nearest - lean), roots.enter, unused);
  balls.meet(on_segment(nearest + lean), unused, roots.leave);
  roots.met = zero <= balls.rr - dot(closest, closest);
  if (rays.has_source) {
    // A ray that leaves the capsule misses it, or has entered it before.
    const WideMask leaves = widen(rays.source == capsule.id);
    roots.enter = select(leaves, Wide(-no_hit), roots.enter);
    roots.met = (leaves & rays.inside) | (~leaves & roots.met);
  }
  return roots;
}

BOULE_INLINE Roots solve_robust(const ExactRays& rays, const CapsuleLanes& capsule) {
  const CapsuleRoots line = meet_lines(rays, capsule);
  Roots roots = first_in_range(line.enter, line.leave, rays);
  roots.hit = roots.hit & line.met;
  return roots;
}

}  // namespace boule::BOULE_KERNEL_ISA
