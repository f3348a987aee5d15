#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/filter_bounds.h"
#include "simd/kernel/search/bundle_source.h"
#include "simd/kernel/search/ray_lanes.h"

/// Up to 1024 rays that share an origin, a direction or an end, in a frame of their own, as
/// filter_bounds.h describes it. They walk a tree together.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr int bundle_packets = bundle_size / width;
/// A bundle's rays are culled in so many groups: of 1024 in Morton order, 8 x 4 pixels each.
inline constexpr int bundle_groups = 32;

/// The axes in world coordinates.
struct BundleFrame {
  Vec3d org, u, v, w;
};

/// Ranges of a and b, of some rays or a sphere.
struct Extent {
  float a_low, a_high, b_low, b_high;
};

/// The ranges of every group; one without rays meets nothing.
struct GroupExtents {
  alignas(64) float a_low[bundle_groups], a_high[bundle_groups];
  alignas(64) float b_low[bundle_groups], b_high[bundle_groups];

  BOULE_INLINE void set(int group, const Extent& e) {
    a_low[group] = e.a_low;
    a_high[group] = e.a_high;
    b_low[group] = e.b_low;
    b_high[group] = e.b_high;
  }
};

/// The rays of a bundle as its filters see them.
struct BundleRays {
  BundleFrame frame;
  int packets;           ///< of which the last may hold copies
  int group_packets;     ///< of each group but the last ones
  float across;          ///< D
  float shift;           ///< lines with a common end miss it by at most this
  float squared_across;  ///< rho^2; 0 with one direction
  float c_low, c_high;   ///< origins along W; 0 with one origin
  Extent extent;         ///< of all rays
  GroupExtents groups;
  alignas(64) float a[bundle_size], b[bundle_size];
  alignas(64) float c[bundle_size];      ///< origin along W; with one direction only
  alignas(64) float scale[bundle_size];  ///< v / t
};

/// Packets begin .. end - 1 of a bundle.
struct PacketRange {
  int begin, end;
};
BOULE_INLINE PacketRange packets_of(const BundleRays& rays, int group) {
  const int begin = group * rays.group_packets, end = begin + rays.group_packets;
  return {begin, end < rays.packets ? end : rays.packets};
}

BOULE_INLINE Vec3d scaled_to_unit(const Vec3d& v) { return v * (1 / __builtin_sqrt(dot(v, v))); }

/// W along `forward`, U as near to `side` as that allows. NaN comes from NaN, and from no forward.
BOULE_INLINE BundleFrame make_frame(const Vec3d& org, const Vec3d& forward, const Vec3d& side) {
  const Vec3d w = scaled_to_unit(forward);
  Vec3d across = side - w * dot(side, w);
  if (!(dot(across, across) > 1e-12 * dot(side, side))) {
    // Any axis will do that is not along W.
    const Vec3d axis = __builtin_fabs(w.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    across = axis - w * dot(axis, w);
  }
  across = scaled_to_unit(across);
  const Vec3d u = scaled_to_unit(across - w * dot(across, w));
  return {org, u, cross(w, u), w};
}

/// A ray in its bundle's frame.
struct Projected {
  Real a, b, c, scale, across, shift;
};

/// Puts rays into the frame of their bundle.
template <Common common>
class Projection {
 public:
  /// `middle`: the sight along which W goes, or what directions all have in common.
  Projection(const BundleFrame& frame, const Vec3d& middle)
      : middle_(narrow_all(middle)),
        u_(narrow_all(frame.u)),
        v_(narrow_all(frame.v)),
        w_(narrow_all(frame.w)),
        length_(static_cast<float>(__builtin_sqrt(dot(middle, middle)))) {}

  BOULE_INLINE Projected project(const Sight& ray) const {
    const Vec3<Real>& sight = ray.sight;
    if constexpr (common == Common::origin) {
      const Vec3<Real> off = sight - middle_;
      const Real inverse = Real(1.0F) / (length_ + filter_dot(off, w_));
      return {filter_dot(off, u_) * inverse,      filter_dot(off, v_) * inverse, Real(0.0F),
              filter_dot(sight, sight) * inverse, sum_abs_of(off) * inverse,     ray.shift};
    } else if constexpr (common == Common::end) {
      const Vec3<Real> back{Real(0.0F) - sight.x, Real(0.0F) - sight.y, Real(0.0F) - sight.z};
      const Real inverse = Real(1.0F) / filter_dot(back, w_);
      return {filter_dot(back, u_) * inverse,     filter_dot(back, v_) * inverse, Real(0.0F),
              filter_dot(sight, sight) * inverse, sum_abs_of(back) * inverse,     ray.shift};
    } else {
      return {filter_dot(sight, u_), filter_dot(sight, v_),
              filter_dot(sight, w_), length_,
              sum_abs_of(sight),     ray.shift};
    }
  }

 private:
  Vec3<Real> middle_, u_, v_, w_;
  Real length_;
};

/// Cuts to 0 .. last; 0 for NaN.
BOULE_INLINE Real cut_to_cells(const Real& x, int last) {
  const Real zero(0.0F), end(static_cast<float>(last));
  const Real low = select(zero <= x, x, zero);
  return select(low <= end, low, end);
}

/// Ranges that grow ray by ray, W at a time.
inline constexpr Extent no_extent = {static_cast<float>(no_hit), -static_cast<float>(no_hit),
                                     static_cast<float>(no_hit), -static_cast<float>(no_hit)};
struct ExtentLanes {
  Real a_low{static_cast<float>(no_hit)}, a_high{-static_cast<float>(no_hit)};
  Real b_low{static_cast<float>(no_hit)}, b_high{-static_cast<float>(no_hit)};

  BOULE_INLINE void add(const Real& a, const Real& b) {
    a_low = filter_min(a_low, a);
    a_high = filter_max(a_high, a);
    b_low = filter_min(b_low, b);
    b_high = filter_max(b_high, b);
  }
  /// Ranges of some lanes.
  BOULE_INLINE void add(const RealMask& lanes, const Real (&low)[2], const Real (&high)[2]) {
    a_low = select(lanes, filter_min(a_low, low[0]), a_low);
    a_high = select(lanes, filter_max(a_high, high[0]), a_high);
    b_low = select(lanes, filter_min(b_low, low[1]), b_low);
    b_high = select(lanes, filter_max(b_high, high[1]), b_high);
  }
  [[nodiscard]] BOULE_INLINE Extent total() const {
    return {least_lane(a_low), greatest_lane(a_high), least_lane(b_low), greatest_lane(b_high)};
  }
};

BOULE_INLINE Extent extent_of_both(const Extent& a, const Extent& b) {
  return {a.a_low < b.a_low ? a.a_low : b.a_low, a.a_high > b.a_high ? a.a_high : b.a_high,
          a.b_low < b.b_low ? a.b_low : b.b_low, a.b_high > b.b_high ? a.b_high : b.b_high};
}

/// Rays that miss their common end by more of their length than this are no bundle. What bounds
/// say of them is true, but too little.
inline constexpr float farthest_end = 0x1p-10F;

/// What load_bundle() finds out about all its rays, W at a time.
struct BundleSums {
  RealMask belongs = Real(0.0F) <= Real(0.0F);
  Real across{0.0F}, squared{0.0F}, c_low{0.0F}, c_high{0.0F}, shift{0.0F}, scale{0.0F};

  template <Common common>
  BOULE_INLINE void add(const Projected& ray) {
    constexpr float widest = common == Common::origin ? filter::bundle_across
                             : common == Common::end  ? 2 * filter::bundle_across
                                                      : filter::bundle_far;
    // NaN passes none of these.
    belongs = belongs & (ray.across <= Real(widest)) & (ray.scale < Real(filter::limit)) &
              (Real(1 / filter::limit) < ray.scale) & (ray.shift <= ray.scale * Real(farthest_end));
    across = filter_max(across, ray.across);
    shift = filter_max(shift, ray.shift);
    if constexpr (common == Common::end) scale = filter_max(scale, ray.scale);
    if constexpr (common != Common::direction) {
      squared = filter_max(squared, filter_fma(ray.a, ray.a, ray.b * ray.b));
    } else {
      c_low = filter_min(c_low, ray.c);
      c_high = filter_max(c_high, ray.c);
    }
  }
};

/// Puts the rays of these packets into their bundle's frame and returns their extent.
template <Common common, Seek seek, class Source>
BOULE_INLINE Extent load_group(const Source& source, const Projection<common>& projection,
                               const PacketRange& packets, BundleRays& bundle, BundleSums& sums) {
  if (packets.begin >= packets.end) return no_extent;
  ExtentLanes extent;
  for (int p = packets.begin; p < packets.end; ++p) {
    const int at = p * width;
    source.prefetch_next(at);
    const Projected ray = projection.project(source.sight(at));
    sums.belongs = sums.belongs & source.template belongs<seek>(at);
    sums.template add<common>(ray);
    extent.add(ray.a, ray.b);
    store(bundle.a + at, ray.a);
    store(bundle.b + at, ray.b);
    store(bundle.scale + at, ray.scale);
    if constexpr (common == Common::direction) store(bundle.c + at, ray.c);
  }
  return extent.total();
}

BOULE_INLINE bool in_bundle_range(const Vec3d& v) {
  const double limit = double{filter::limit};
  return __builtin_fabs(v.x) < limit && __builtin_fabs(v.y) < limit && __builtin_fabs(v.z) < limit;
}

/// The frame of a bundle, W along the sight of ray `middle`.
template <Common common, class Source>
BOULE_INLINE BundleFrame frame_of(const Source& source, const Vec3d& middle) {
  // In Morton order ray 1/3 is the corner along x of a tile.
  const Vec3d side = source.one_sight((source.count() - 1) / 3) - source.one_sight(0);
  return make_frame(source.org(), common == Common::end ? -middle : middle, side);
}

/// At most bundle_size rays as a bundle. False if they are none: they do not share what they must,
/// are too wide, or not finite.
template <Common common, Seek seek, class Source>
BOULE_NOINLINE bool load_bundle(const Source& source, BundleRays& bundle) {
  const int count = source.count();
  // In Morton order ray 3/4 is the middle of a tile.
  const Vec3d middle = common == Common::direction ? source.dir() : source.one_sight(count * 3 / 4);
  if (!in_bundle_range(source.org()) || !in_bundle_range(middle)) return false;
  bundle.frame = frame_of<common>(source, middle);
  bundle.packets = (count + width - 1) / width;
  bundle.group_packets = (bundle.packets + bundle_groups - 1) / bundle_groups;

  const Projection<common> projection(bundle.frame, middle);
  BundleSums sums;
  bundle.extent = no_extent;
  for (int group = 0; group < bundle_groups; ++group) {
    const PacketRange packets = packets_of(bundle, group);
    const Extent extent = load_group<common, seek>(source, projection, packets, bundle, sums);
    bundle.groups.set(group, extent);
    bundle.extent = extent_of_both(bundle.extent, extent);
    if (!all(sums.belongs)) return false;
  }
  bundle.across = greatest_lane(sums.across);
  bundle.squared_across = greatest_lane(sums.squared);
  bundle.c_low = least_lane(sums.c_low);
  bundle.c_high = greatest_lane(sums.c_high);
  const Vec3d& o = bundle.frame.org;
  const double lost = __builtin_fabs(o.x) + __builtin_fabs(o.y) + __builtin_fabs(o.z) +
                      double{greatest_lane(sums.scale)};
  bundle.shift =
      common != Common::end
          ? 0.0F
          : static_cast<float>((double{greatest_lane(sums.shift)} + lost * filter::bundle_end) *
                               filter::bundle_shift_slope);
  const float most = common != Common::direction ? filter::bundle_width : filter::bundle_far;
  const Extent& e = bundle.extent;
  return -most <= e.a_low && e.a_high <= most && -most <= e.b_low && e.b_high <= most;
}

}  // namespace boule::BOULE_KERNEL_ISA
