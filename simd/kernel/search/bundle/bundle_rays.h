#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/filter_bounds.h"
#include "simd/kernel/search/bundle/bundle_extent.h"
#include "simd/kernel/search/bundle/bundle_frame.h"
#include "simd/kernel/search/bundle/bundle_source.h"
#include "simd/kernel/tuning.h"

/// The rays of a bundle, in its frame and ready for its filters. load_bundle() takes them from a
/// source, or reports that they form no bundle.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr int bundle_size = tuning::bundle_size;
inline constexpr int bundle_packets = bundle_size / width;
inline constexpr int bundle_groups = tuning::bundle_groups;

/// The extents of all groups, one after the other; the extent of an empty group meets nothing.
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

/// The rays of a bundle for its filters.
struct BundleRays {
  BundleFrame frame;
  int packets;           ///< the last one may hold copies
  int group_packets;     ///< packets per group; the last groups may have fewer, or be empty
  float across;          ///< D of filter_bounds.h: how far rays differ from the one along W
  float shift;           ///< lines with a common end miss it by at most this
  float squared_across;  ///< the largest a^2 + b^2; 0 with a common direction
  float c_low, c_high;   ///< the range of c; 0 without a common direction
  Extent extent;         ///< of all rays
  GroupExtents groups;
  alignas(64) float a[bundle_size], b[bundle_size];
  alignas(64) float c[bundle_size];      ///< the origin along W; only with a common direction
  alignas(64) float scale[bundle_size];  ///< v / t
};

/// Packets begin .. end - 1 of a bundle.
struct PacketRange {
  int begin, end;
};
/// The packets of a group.
BOULE_INLINE PacketRange packets_of(const BundleRays& rays, int group) {
  const int begin = group * rays.group_packets, end = begin + rays.group_packets;
  return {begin, end < rays.packets ? end : rays.packets};
}

/// The largest of the groups' numbers.
BOULE_INLINE float greatest_of_groups(const float* numbers) {
  Real most = load(numbers);
  for (int at = width; at < bundle_groups; at += width) most = filter_max(most, load(numbers + at));
  return greatest_lane(most);
}

/// The sums of load_bundle() over all rays, W at a time.
struct BundleSums {
  RealMask belongs = uniform(true);
  Real across{0.0F}, squared{0.0F}, c_low{0.0F}, c_high{0.0F}, shift{0.0F}, scale{0.0F};

  template <Common common>
  BOULE_INLINE void add(const Projected& ray) {
    constexpr float widest = common == Common::origin ? filter::bundle_across
                             : common == Common::end  ? 2 * filter::bundle_across
                                                      : filter::bundle_far;
    // NaN is outside these ranges.
    belongs = belongs & (ray.across <= Real(widest)) & (ray.scale < Real(filter::limit)) &
              (Real(1 / filter::limit) < ray.scale) &
              (ray.shift <= ray.scale * Real(tuning::farthest_end));
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

/// Projects the rays of these packets into their bundle's frame and returns their extent.
template <Common common, Sought sought, class Source>
BOULE_INLINE Extent load_group(const Source& source, const Projection<common>& projection,
                               const PacketRange& packets, BundleRays& bundle, BundleSums& sums) {
  if (packets.begin >= packets.end) return no_extent;
  ExtentLanes extent;
  for (int p = packets.begin; p < packets.end; ++p) {
    const int at = p * width;
    source.prefetch_next(at);
    const Projected ray = projection.project(source.sight(at));
    sums.belongs = sums.belongs & source.template belongs<sought>(at);
    sums.template add<common>(ray);
    extent.add(ray.a, ray.b);
    store(bundle.a + at, ray.a);
    store(bundle.b + at, ray.b);
    store(bundle.scale + at, ray.scale);
    if constexpr (common == Common::direction) store(bundle.c + at, ray.c);
  }
  return extent.total();
}

/// Completes the bundle from the sums over all rays. Returns false if the rays spread too wide.
template <Common common>
BOULE_INLINE bool finish_bundle(const BundleSums& sums, BundleRays& bundle) {
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

/// Makes a bundle of the rays of a source, at most bundle_size. Returns false if they form no
/// bundle, because the shared numbers differ, the spread is too wide, or numbers are not finite.
template <Common common, Sought sought, class Source>
BOULE_NOINLINE bool load_bundle(const Source& source, BundleRays& bundle) {
  const int count = source.count();
  // In Morton order, the ray at three quarters is in the middle of the tile.
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
    const Extent extent = load_group<common, sought>(source, projection, packets, bundle, sums);
    bundle.groups.set(group, extent);
    bundle.extent = extent_of_both(bundle.extent, extent);
    if (!all(sums.belongs)) return false;
  }
  return finish_bundle<common>(sums, bundle);
}

}  // namespace boule::BOULE_KERNEL_ISA
