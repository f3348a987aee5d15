#pragma once

#include <cstdint>

#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/search/leaf/primitive_access.h"

/// Spheres as discs in a bundle's frame, a block of sixteen at a time: each around (X, Y) at the
/// depth Z. If a sphere is simple for the bundle, its disc and the bounds kept with it decide
/// nearly everything in float. The names are those of simd/abi/filter_bounds.h; docs/numerics.md
/// derives the bounds.
namespace boule::BOULE_KERNEL_ISA {

/// The first spheres of a block, up to sixteen.
class BlockSpheres {
 public:
  static constexpr int size = bvh_leaf_size;

  BOULE_INLINE BlockSpheres(const LeafRef& block, unsigned count)
      : block_(block.block), first_(static_cast<std::uint32_t>(block.first_slot)), count_(count) {}

  /// Bit k is set if there is a k-th sphere.
  [[nodiscard]] BOULE_INLINE unsigned there() const { return (1U << count_) - 1; }
  [[nodiscard]] BOULE_INLINE std::uint32_t slot(int index) const {
    return first_ + static_cast<std::uint32_t>(index);
  }
  /// The centres of W spheres: part p has the indices from p W on.
  BOULE_INLINE Vec3<Real> centers(std::size_t part) const {
    const std::size_t at = part * width;
    return {load(block_.center_x + at), load(block_.center_y + at), load(block_.center_z + at)};
  }
  BOULE_INLINE Real radii(std::size_t part) const { return load(block_.radius + part * width); }
  /// The number of parts that hold a sphere.
  [[nodiscard]] BOULE_INLINE std::size_t parts() const { return (count_ + width - 1) / width; }

 private:
  const SphereBlock& block_;
  std::uint32_t first_;
  unsigned count_;
};

/// The discs of a block's spheres.
struct Discs {
  static constexpr int size = BlockSpheres::size;
  alignas(64) float x[size], y[size], z[size];
  alignas(64) float radius[size], delta[size];
  alignas(64) float squared[size];  ///< R2
  alignas(64) float sure[size];     ///< D2
  alignas(64) float depth[size];    ///< Z - E1
  alignas(64) float spread[size];   ///< upper less lower bound of v of a hit
  alignas(64) float near[size];     ///< lower bound of v over the sphere; inf if it is not simple
  alignas(64) float a_low[size], a_high[size], b_low[size], b_high[size];  ///< its extent

  Extent all;      ///< of all simple ones; only for any hit
  float all_near;  ///< the smallest of `near`; only for any hit

  unsigned simple;   ///< as bits, spheres that may be hit and for which these bounds hold
  unsigned awkward;  ///< as bits, other spheres that may be hit
};

/// The factors of the bounds, the same for all spheres of one bundle.
struct DiscFactors {
  Real axis, constant, exact;  ///< delta = axis |Z| + exact F1 + constant
  Real depth, depth_shift;     ///< E1 = depth F1 + depth_shift
  Real square;                 ///< G = square r^2 + 4 delta (r + delta)
  Real plane_length;           ///< length of the normals of the bundle's sides, rounded up

  BOULE_INLINE DiscFactors(const BundleRays& rays, Common common) {
    constexpr auto u = static_cast<float>(filter::u);
    const float axis_factor = static_cast<float>(filter::bundle_axis * filter::u) * rays.across;
    const bool one_origin = common != Common::direction;
    exact = static_cast<float>(filter::bundle_double);
    depth = static_cast<float>(filter::bundle_depth) * u;
    depth_shift = one_origin ? rays.shift : depth * rays.across;
    axis = one_origin ? axis_factor : 0.0F;
    constant = static_cast<float>(filter::floor) + (one_origin ? rays.shift : axis_factor);
    square = rays.squared_across + static_cast<float>(filter::bundle_square) * u;
    plane_length = one_origin ? filter::bundle_side : filter::bundle_side_parallel;
  }
};

/// Lanes of spheres beyond one of the bundle's four sides, which all rays miss. `reach`: the
/// largest distance from the centre of a line that hits the sphere.
template <Common common>
BOULE_INLINE RealMask outside(const Extent& extent, const Vec3<Real>& center, const Real& reach) {
  const Real zero(0.0F);
  if constexpr (common != Common::direction) {
    return (filter_fnma(extent.a_low, center.z, center.x) + reach < zero) |
           (reach < filter_fnma(extent.a_high, center.z, center.x)) |
           (filter_fnma(extent.b_low, center.z, center.y) + reach < zero) |
           (reach < filter_fnma(extent.b_high, center.z, center.y));
  } else {
    return (center.x + reach < extent.a_low) | (Real(extent.a_high) + reach < center.x) |
           (center.y + reach < extent.b_low) | (Real(extent.b_high) + reach < center.y);
  }
}

/// Finds the places of the spheres of a part, and whether the bundle may hit them before `limit`.
template <Common common, Sought sought>
BOULE_INLINE void locate_part(const BundleRays& rays, const DiscFactors& factors,
                              const BlockSpheres& spheres, std::size_t part, const Real& limit,
                              Discs& discs) {
  const BundleFrame& frame = rays.frame;
  const Vec3<Wide> f = widen(spheres.centers(part)) - wide_all(frame.org);
  const Vec3<Real> center{narrow(dot(f, wide_all(frame.u))), narrow(dot(f, wide_all(frame.v))),
                          narrow(dot(f, wide_all(frame.w)))};
  const Real r = abs(spheres.radii(part));
  const Real f1 = abs(center.x) + abs(center.y) + abs(center.z);
  const Real delta =
      filter_fma(abs(center.z), factors.axis, filter_fma(f1, factors.exact, factors.constant));
  const Real depth = filter_fnma(f1, factors.depth, center.z - factors.depth_shift);
  const Real near = depth - r - rays.c_high;
  const Real reach = (r + delta + delta) * factors.plane_length;
  const RealMask judged = f1 < Real(filter::bundle_far);
  const RealMask missed = judged & outside<common>(rays.extent, center, reach);
  RealMask simple = judged & (r < Real(filter::bundle_far));
  // Parallel rays begin anywhere among the spheres. For any hit, bounds of v tell whether a sphere
  // lies behind the origin.
  if constexpr (common != Common::direction || sought == Sought::nearest)
    simple = simple & (r + r + Real(rays.c_high) <= center.z);
  if constexpr (common != Common::direction)
    simple = simple & (Real(static_cast<float>(filter::floor)) <= center.z);  // 1 / Z is finite
  const std::size_t at = part * width;
  discs.awkward |= bits(~simple & ~missed & (r <= r)) << at;  // rays miss NaN
  store(discs.x + at, center.x);
  store(discs.y + at, center.y);
  store(discs.z + at, center.z);
  store(discs.radius + at, r);
  store(discs.delta + at, delta);
  store(discs.depth + at, depth);
  simple = simple & ~missed & (near <= limit);
  store(discs.near + at, select(simple, near, Real(static_cast<float>(no_hit))));
  discs.simple |= bits(simple) << at;
}

/// Finds the spheres of a block that may be hit, and their places.
template <Common common, Sought sought>
BOULE_INLINE void locate_discs(const BundleRays& rays, const DiscFactors& factors,
                               const BlockSpheres& spheres, float limit, Discs& discs) {
  discs.simple = discs.awkward = 0;
  for (std::size_t part = 0; part < spheres.parts(); ++part)
    locate_part<common, sought>(rays, factors, spheres, part, limit, discs);
  const unsigned there = spheres.there();
  discs.simple &= there;
  discs.awkward &= there;
}

/// Finds the bounds of the spheres that may be hit.
template <Common common, Sought sought>
BOULE_INLINE void bound_discs(const DiscFactors& factors, std::size_t parts, Discs& discs) {
  ExtentLanes all;
  Real all_near(static_cast<float>(no_hit));
  for (std::size_t at = 0; at < parts * width; at += width) {
    const Real x = load(discs.x + at), y = load(discs.y + at), z = load(discs.z + at);
    const Real r = load(discs.radius + at), delta = load(discs.delta + at);
    const Real grown = Real(4.0F) * delta * (r + delta), square = r * r;
    const Real g = filter_fma(square, factors.square, grown), squared = square + g;
    const Real sure = g + g + grown, e1 = z - load(discs.depth + at);
    store(discs.squared + at, squared);
    store(discs.sure + at, sure);
    store(discs.spread + at, filter_fma(e1, Real(filter::bundle_twice), sqrt(sure)));
    // The a of a ray that hits the sphere: |a - X / Z| <= (sqrt(R2) + 2 delta) / Z.
    const Real half = sqrt(squared) + delta + delta;
    Real a = x, b = y, wide = half;
    if constexpr (common != Common::direction) {
      const Real inverse = Real(1.0F) / z;
      a = x * inverse;
      b = y * inverse;
      wide = half * inverse;
    }
    store(discs.a_low + at, a - wide);
    store(discs.a_high + at, a + wide);
    store(discs.b_low + at, b - wide);
    store(discs.b_high + at, b + wide);
    if constexpr (sought == Sought::any) {
      const Real near = load(discs.near + at);
      const RealMask simple = near < Real(static_cast<float>(no_hit));
      all.add(simple, {a - wide, b - wide}, {a + wide, b + wide});
      all_near = filter_min(all_near, near);
    }
  }
  if constexpr (sought == Sought::any) {
    discs.all = all.total();
    discs.all_near = least_lane(all_near);
  }
}

/// The groups, as bits, that have a ray which may lie in an extent and whose limit is at least
/// `least`.
BOULE_INLINE unsigned groups_near(const GroupExtents& groups, const float* limits, const Extent& e,
                                  float least) {
  const Real a_low(e.a_low), a_high(e.a_high), b_low(e.b_low), b_high(e.b_high), near(least);
  unsigned result = 0;
  for (int at = 0; at < bundle_groups; at += width) {
    const RealMask in = (a_low <= load(groups.a_high + at)) & (load(groups.a_low + at) <= a_high) &
                        (b_low <= load(groups.b_high + at)) & (load(groups.b_low + at) <= b_high) &
                        (near <= load(limits + at));
    result |= bits(in) << at;
  }
  return result;
}

/// The same for the extent of disc k.
BOULE_INLINE unsigned groups_near(const GroupExtents& groups, const float* limits,
                                  const Discs& discs, int k) {
  return groups_near(groups, limits,
                     {discs.a_low[k], discs.a_high[k], discs.b_low[k], discs.b_high[k]},
                     discs.near[k]);
}

}  // namespace boule::BOULE_KERNEL_ISA
