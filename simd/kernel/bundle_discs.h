#pragma once

#include <cstdint>

#include "simd/kernel/bundle_rays.h"
#include "simd/kernel/primitive_access.h"

/// Spheres as a bundle sees them, eight at a time: each a disc around (X, Y) at the depth Z.
namespace boule::BOULE_KERNEL_ISA {

/// Eight discs; where there are more lanes, they come twice.
struct Discs {
  static constexpr int size = width < 8 ? 8 : width;
  alignas(64) float x[size], y[size], z[size];
  alignas(64) float squared[size];  ///< R2
  alignas(64) float sure[size];     ///< D2
  alignas(64) float depth[size];    ///< Z - E1
  alignas(64) float spread[size];   ///< from the lower to the upper bound of v
  alignas(64) float near[size];     ///< nothing of it is nearer than this v
  alignas(64) float a_low[size], a_high[size], b_low[size], b_high[size];

  unsigned simple;   ///< bits: discs that may be hit and that these bounds hold for
  unsigned awkward;  ///< bits: spheres that may be hit and that they do not hold for
};

/// The bounds' factors for one bundle.
struct DiscFactors {
  Real center, axis, constant;  ///< delta = center (|X| + |Y|) + axis |Z| + exact F1 + constant
  Real square;                  ///< G = square r^2 + ...
  Real plane_length;            ///< |n| of the bundle's sides, outward

  BOULE_INLINE DiscFactors(const BundleRays& rays, Common common) {
    constexpr auto u = static_cast<float>(filter::u);
    const auto center_factor = static_cast<float>(filter::bundle_center * filter::u);
    const float axis_factor = static_cast<float>(filter::bundle_axis * filter::u) * rays.across;
    const bool one_origin = common == Common::origin;
    center = center_factor;
    axis = one_origin ? axis_factor : 0.0F;
    constant = static_cast<float>(filter::floor) + (one_origin ? 0.0F : axis_factor);
    square = rays.squared_across * (1 + 8 * u) + static_cast<float>(filter::bundle_square) * u;
    plane_length = one_origin ? 1.05F : 1.001F;
  }
};

/// Lanes of spheres that no ray of the bundle meets: beyond one of its four sides.
template <Common common>
BOULE_INLINE RealMask outside(const Extent& extent, const Vec3<Real>& center, const Real& reach) {
  const Real zero(0.0F);
  if constexpr (common == Common::origin) {
    return (filter_fnma(extent.a_low, center.z, center.x) + reach < zero) |
           (reach < filter_fnma(extent.a_high, center.z, center.x)) |
           (filter_fnma(extent.b_low, center.z, center.y) + reach < zero) |
           (reach < filter_fnma(extent.b_high, center.z, center.y));
  } else {
    return (center.x + reach < extent.a_low) | (Real(extent.a_high) + reach < center.x) |
           (center.y + reach < extent.b_low) | (Real(extent.b_high) + reach < center.y);
  }
}

/// The part `part` of eight spheres.
template <Common common>
BOULE_INLINE void make_discs(const BundleRays& rays, const DiscFactors& factors,
                             const SlotPlace& spheres, std::size_t part, Discs& discs) {
  constexpr auto u = static_cast<float>(filter::u);
  const BundleFrame& frame = rays.frame;
  const Vec3<Wide> f =
      widen(Vec3<Real>{load_of_eight(spheres.center_x, part), load_of_eight(spheres.center_y, part),
                       load_of_eight(spheres.center_z, part)}) -
      wide_all(frame.org);
  const Vec3<Real> center{narrow(dot(f, wide_all(frame.u))), narrow(dot(f, wide_all(frame.v))),
                          narrow(dot(f, wide_all(frame.w)))};
  const Real r = abs(load_of_eight(spheres.radius, part));
  const Real aside = abs(center.x) + abs(center.y), f1 = aside + abs(center.z);
  const Real delta = filter_fma(
      aside, factors.center,
      filter_fma(abs(center.z), factors.axis,
                 filter_fma(f1, static_cast<float>(filter::bundle_double), factors.constant)));
  // A line that meets the sphere is this near its centre, and it is this wide.
  const Real reach = (r + delta + delta) * factors.plane_length;
  const RealMask far_off =
      outside<common>(rays.extent, center, reach) & (f1 < Real(filter::bundle_far));
  const RealMask simple = (r + r + Real(rays.c_high) <= center.z) &
                          (f1 < Real(filter::bundle_far)) & (Real(filter::bundle_small) < r);

  const Real grown = Real(4.0F) * delta * (r + delta), square = r * r;
  const Real g = filter_fma(square, factors.square, grown), squared = square + g;
  const Real e1 = f1 * Real(static_cast<float>(filter::bundle_depth) * u);
  const Real sure = g + g + grown;
  const std::size_t at = part * width;
  store(discs.x + at, center.x);
  store(discs.y + at, center.y);
  store(discs.z + at, center.z);
  store(discs.squared + at, squared);
  store(discs.sure + at, sure);
  store(discs.depth + at, center.z - e1);
  store(discs.spread + at, filter_fma(sqrt(sure), Real(1 + 8 * u), e1 + e1));
  store(discs.near + at, center.z - e1 - r * Real(1 + 8 * u) - Real(rays.c_high));

  // Where the group's extents may meet the disc: |a - X / Z| <= (r' + delta) / Z.
  const Real half = (sqrt(squared) + delta + delta) * Real(1 + 8 * u);
  if constexpr (common == Common::origin) {
    const Real inverse = Real(1.0F) / center.z;
    const Real a = center.x * inverse, b = center.y * inverse, wide = half * inverse;
    const Real more_a = filter_fma(abs(a), Real(8 * u), wide + wide * Real(8 * u));
    const Real more_b = filter_fma(abs(b), Real(8 * u), wide + wide * Real(8 * u));
    store(discs.a_low + at, a - more_a);
    store(discs.a_high + at, a + more_a);
    store(discs.b_low + at, b - more_b);
    store(discs.b_high + at, b + more_b);
  } else {
    const Real more_a = filter_fma(abs(center.x), Real(8 * u), half);
    const Real more_b = filter_fma(abs(center.y), Real(8 * u), half);
    store(discs.a_low + at, center.x - more_a);
    store(discs.a_high + at, center.x + more_a);
    store(discs.b_low + at, center.y - more_b);
    store(discs.b_high + at, center.y + more_b);
  }
  discs.simple |= (bits(simple & ~far_off)) << at;
  discs.awkward |= (bits(~simple & ~far_off)) << at;
}

/// Eight spheres, of which there are `count`.
template <Common common>
BOULE_INLINE void make_discs(const BundleRays& rays, const DiscFactors& factors,
                             const SlotPlace& spheres, unsigned count, Discs& discs) {
  discs.simple = discs.awkward = 0;
  for (std::size_t part = 0; part * width < count; ++part)
    make_discs<common>(rays, factors, spheres, part, discs);
  const unsigned there = (1U << count) - 1;
  discs.simple &= there;
  discs.awkward &= there;
}

/// Bits of the discs that some ray within `extent` may meet, no farther than `limit`.
BOULE_INLINE unsigned discs_near(const Discs& discs, const Extent& extent, float limit,
                                 unsigned count) {
  unsigned result = 0;
  for (std::size_t at = 0; at < count; at += width) {
    const RealMask in = (load(discs.a_low + at) <= Real(extent.a_high)) &
                        (Real(extent.a_low) <= load(discs.a_high + at)) &
                        (load(discs.b_low + at) <= Real(extent.b_high)) &
                        (Real(extent.b_low) <= load(discs.b_high + at)) &
                        (load(discs.near + at) <= Real(limit));
    result |= bits(in) << at;
  }
  return result & discs.simple;
}

}  // namespace boule::BOULE_KERNEL_ISA
