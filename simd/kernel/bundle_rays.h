#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/filter_bounds.h"
#include "simd/kernel/packet.h"
#include "simd/kernel/padded_stream.h"

/// Up to 1024 rays that share an origin, a direction or an end, in a frame of their own, as
/// filter_bounds.h describes it. They walk a tree together.
namespace boule::BOULE_KERNEL_ISA {

/// What a bundle's rays have in common. `end`: the point at t = 1; such rays are seen from there,
/// backwards.
enum class Common { origin, direction, end };

/// What is asked for.
enum class Seek { nearest, any };

inline constexpr int bundle_size = 1024;
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
  std::size_t first;     ///< ray of the stream
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

BOULE_INLINE Vec3d direction_of(const RayStream& rays, std::size_t i) {
  return {double{rays.dir_x[i]}, double{rays.dir_y[i]}, double{rays.dir_z[i]}};
}
BOULE_INLINE Vec3d origin_of(const RayStream& rays, std::size_t i) {
  return {rays.org_x[i], rays.org_y[i], rays.org_z[i]};
}
BOULE_INLINE Vec3d scaled_to_unit(const Vec3d& v) { return v * (1 / __builtin_sqrt(dot(v, v))); }
BOULE_INLINE Vec3<Real> narrow_all(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
BOULE_INLINE Vec3<Wide> wide_all(const Vec3d& v) { return {v.x, v.y, v.z}; }

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
  /// `middle`: the ray along whose direction, or through whose origin, W goes.
  Projection(const BundleFrame& frame, const RayStream& rays, std::size_t middle)
      : org_(wide_all(frame.org)),
        dir_(narrow_all(direction_of(rays, middle))),
        u_(narrow_all(frame.u)),
        v_(narrow_all(frame.v)),
        w_(narrow_all(frame.w)),
        length_(static_cast<float>(
            __builtin_sqrt(dot(direction_of(rays, middle), direction_of(rays, middle))))) {}

  BOULE_INLINE Projected project(const RayStream& rays, std::size_t first) const {
    if constexpr (common == Common::origin) {
      const Vec3<Real> dir = load_direction(rays, first), off = dir - dir_;
      const Real inverse = Real(1.0F) / (length_ + filter_dot(off, w_));
      return {filter_dot(off, u_) * inverse,  filter_dot(off, v_) * inverse, Real(0.0F),
              filter_dot(dir, dir) * inverse, sum_abs_of(off) * inverse,     Real(0.0F)};
    } else if constexpr (common == Common::end) {
      const Vec3<Real> dir = load_direction(rays, first);
      const Vec3<Real> back{Real(0.0F) - dir.x, Real(0.0F) - dir.y, Real(0.0F) - dir.z};
      const Real inverse = Real(1.0F) / filter_dot(back, w_);
      const Vec3<Wide> end = load_origin(rays, first) + widen(dir);
      return {filter_dot(back, u_) * inverse,
              filter_dot(back, v_) * inverse,
              Real(0.0F),
              filter_dot(dir, dir) * inverse,
              sum_abs_of(back) * inverse,
              sum_abs_of(narrow(end - org_))};
    } else {
      const Vec3<Real> off = narrow(load_origin(rays, first) - org_);
      return {filter_dot(off, u_), filter_dot(off, v_), filter_dot(off, w_), length_,
              sum_abs_of(off),     Real(0.0F)};
    }
  }

  /// Lanes whose rays may be in the bundle: what they must share they do, they live from t = 0 on
  /// and, to seek the nearest hit, leave nothing.
  template <Seek seek>
  BOULE_INLINE RealMask belongs(const RayStream& rays, std::size_t first) const {
    const Real zero(0.0F), tmin = load(rays.tmin + first);
    std::int32_t source = -1;
    if constexpr (seek == Seek::nearest) {
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(width); ++lane)
        source &= rays.source[first + lane];
    }
    const RealMask fresh =
        (tmin <= zero) & (zero <= tmin) & (Real(source == -1 ? 0.0F : 1.0F) <= zero);
    if constexpr (common == Common::end) {
      // `shift` tells the rest; what is behind the end is not seen.
      return fresh & (load(rays.tmax + first) <= Real(1.0F));
    } else if constexpr (common == Common::origin) {
      const Vec3<Wide> org = load_origin(rays, first);
      const WideMask same = (org.x == org_.x) & (org.y == org_.y) & (org.z == org_.z);
      return fresh & (bits(same) == all_lanes ? zero <= zero : zero < zero);
    } else {
      const Vec3<Real> dir = load_direction(rays, first);
      return fresh & (dir.x <= dir_.x) & (dir_.x <= dir.x) & (dir.y <= dir_.y) & (dir_.y <= dir.y) &
             (dir.z <= dir_.z) & (dir_.z <= dir.z);
    }
  }

 private:
  BOULE_INLINE static Vec3<Real> load_direction(const RayStream& rays, std::size_t first) {
    return {load(rays.dir_x + first), load(rays.dir_y + first), load(rays.dir_z + first)};
  }
  BOULE_INLINE static Vec3<Wide> load_origin(const RayStream& rays, std::size_t first) {
    return {load(rays.org_x + first), load(rays.org_y + first), load(rays.org_z + first)};
  }
  BOULE_INLINE static Real sum_abs_of(const Vec3<Real>& v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
  }

  Vec3<Wide> org_;
  Vec3<Real> dir_, u_, v_, w_;
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

/// What load_bundle() finds out about all its rays, W at a time.
struct BundleSums {
  RealMask belongs = Real(0.0F) <= Real(0.0F);
  Real across{0.0F}, squared{0.0F}, c_low{0.0F}, c_high{0.0F}, shift{0.0F};

  template <Common common>
  BOULE_INLINE void add(const Projected& ray) {
    constexpr float widest = common == Common::origin ? 1.0F
                             : common == Common::end  ? 2.0F
                                                      : filter::bundle_far;
    // NaN passes none of these.
    belongs = belongs & (ray.across <= Real(widest)) & (ray.scale < Real(filter::limit)) &
              (Real(1 / filter::limit) < ray.scale) &
              (ray.shift <= ray.scale * Real(filter::bundle_shift));
    across = filter_max(across, ray.across);
    shift = filter_max(shift, ray.shift);
    if constexpr (common != Common::direction) {
      squared = filter_max(squared, filter_fma(ray.a, ray.a, ray.b * ray.b));
    } else {
      c_low = filter_min(c_low, ray.c);
      c_high = filter_max(c_high, ray.c);
    }
  }
};

/// Asks for the packet at `first`, unless the stream ends before it: a bundle's rays come once, and
/// from memory.
BOULE_INLINE void prefetch_packet(const RayStream& rays, std::size_t first) {
  if (first >= rays.size) return;
  for (int line = 0; line * 8 < width; ++line) {
    __builtin_prefetch(rays.org_x + first + line * 8);
    __builtin_prefetch(rays.org_y + first + line * 8);
    __builtin_prefetch(rays.org_z + first + line * 8);
  }
  __builtin_prefetch(rays.dir_x + first);
  __builtin_prefetch(rays.dir_y + first);
  __builtin_prefetch(rays.dir_z + first);
  __builtin_prefetch(rays.tmin + first);
  __builtin_prefetch(rays.tmax + first);
  __builtin_prefetch(rays.source + first);
}

/// Puts the rays of these packets into their bundle's frame and returns their extent.
template <Common common, Seek seek>
BOULE_INLINE Extent load_group(const PaddedStream& stream, const Projection<common>& projection,
                               const PacketRange& packets, BundleRays& bundle, BundleSums& sums) {
  if (packets.begin >= packets.end) return no_extent;
  ExtentLanes extent;
  for (int p = packets.begin; p < packets.end; ++p) {
    const PacketPlace place = stream.packet(bundle.first + static_cast<std::size_t>(p * width));
    prefetch_packet(stream.rays(),
                    bundle.first + static_cast<std::size_t>(p * width + bundle_size));
    const Projected ray = projection.project(*place.rays, place.first);
    sums.belongs = sums.belongs & projection.template belongs<seek>(*place.rays, place.first);
    sums.template add<common>(ray);
    extent.add(ray.a, ray.b);
    store(bundle.a + p * width, ray.a);
    store(bundle.b + p * width, ray.b);
    store(bundle.scale + p * width, ray.scale);
    if constexpr (common == Common::direction) store(bundle.c + p * width, ray.c);
  }
  return extent.total();
}

BOULE_INLINE bool in_bundle_range(const Vec3d& v) {
  const double limit = double{filter::limit};
  return __builtin_fabs(v.x) < limit && __builtin_fabs(v.y) < limit && __builtin_fabs(v.z) < limit;
}

/// Rays first .. first + count - 1 of the stream, count at most bundle_size, as a bundle. False if
/// they are none: they do not share what they must, are too wide, or not finite.
template <Common common, Seek seek>
BOULE_NOINLINE bool load_bundle(const PaddedStream& stream, std::size_t first, std::size_t count,
                                BundleRays& bundle) {
  const RayStream& rays = stream.rays();
  // In Morton order ray 3/4 is the middle of a tile, ray 1/3 its corner along x.
  const std::size_t middle = first + count * 3 / 4, corner = first + (count - 1) / 3;
  const Vec3d side = common == Common::origin
                         ? direction_of(rays, corner) - direction_of(rays, first)
                         : origin_of(rays, corner) - origin_of(rays, first);
  const Vec3d forward = direction_of(rays, middle), start = origin_of(rays, middle);
  if (!in_bundle_range(start) || !in_bundle_range(forward)) return false;
  bundle.frame = common == Common::end ? make_frame(start + forward, -forward, side)
                                       : make_frame(start, forward, side);
  bundle.first = first;
  bundle.packets = static_cast<int>((count + width - 1) / width);
  bundle.group_packets = (bundle.packets + bundle_groups - 1) / bundle_groups;

  const Projection<common> projection(bundle.frame, rays, middle);
  BundleSums sums;
  bundle.extent = no_extent;
  for (int group = 0; group < bundle_groups; ++group) {
    const PacketRange packets = packets_of(bundle, group);
    const Extent extent = load_group<common, seek>(stream, projection, packets, bundle, sums);
    bundle.groups.set(group, extent);
    bundle.extent = extent_of_both(bundle.extent, extent);
    if (!all(sums.belongs)) return false;
  }
  bundle.across = greatest_lane(sums.across);
  bundle.squared_across = greatest_lane(sums.squared);
  bundle.c_low = least_lane(sums.c_low);
  bundle.c_high = greatest_lane(sums.c_high);
  // 2^-50 of the end's own size was lost when it was found.
  const Vec3d& o = bundle.frame.org;
  const double lost = __builtin_fabs(o.x) + __builtin_fabs(o.y) + __builtin_fabs(o.z);
  bundle.shift = common != Common::end
                     ? 0.0F
                     : static_cast<float>((double{greatest_lane(sums.shift)} + lost * 0x1p-50) *
                                          filter::bundle_shift_slope);
  const float most = common != Common::direction ? filter::bundle_width : filter::bundle_far;
  const Extent& e = bundle.extent;
  return -most <= e.a_low && e.a_high <= most && -most <= e.b_low && e.b_high <= most;
}

}  // namespace boule::BOULE_KERNEL_ISA
