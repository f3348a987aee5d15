#pragma once

#include <cstddef>

#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/leaf/ray_lanes.h"

/// The ranges of the numbers of some neighbours in a stream, which bound where those rays can go.
namespace boule::BOULE_KERNEL_ISA {

/// A box, as its middle and half its size. NaN where the numbers are not finite.
struct BoxAround {
  Vec3d mid, half;
};

/// The smallest and the greatest numbers that were added, in lanes. NaN is left out.
struct RangeLanes {
  Real low{static_cast<float>(no_hit)}, high{-static_cast<float>(no_hit)};

  BOULE_INLINE void add(const Real& x) {
    low = lesser_or(x, low);
    high = greater_or(x, high);
  }
  BOULE_INLINE void get(double& mid, double& half) const {
    const double from = double{least_lane(low)}, to = double{greatest_lane(high)};
    mid = (from + to) / 2;
    half = (to - from) / 2;
  }
};

struct VectorRange {
  Vec3<RangeLanes> range;

  BOULE_INLINE void add(const Vec3<Real>& v) {
    range.x.add(v.x);
    range.y.add(v.y);
    range.z.add(v.z);
  }
  [[nodiscard]] BOULE_INLINE BoxAround box() const {
    BoxAround box{};
    range.x.get(box.mid.x, box.half.x);
    range.y.get(box.mid.y, box.half.y);
    range.z.get(box.mid.z, box.half.z);
    return box;
  }
};

/// A box that holds numbers whose roundings to float are in the other box.
BOULE_INLINE BoxAround before_rounding(const BoxAround& box) {
  const auto grown = [](double mid, double half) {
    return half + 2 * filter::u * ((mid < 0 ? -mid : mid) + half) + filter::floor;
  };
  return {
      box.mid,
      {grown(box.mid.x, box.half.x), grown(box.mid.y, box.half.y), grown(box.mid.z, box.half.z)}};
}

/// What holds the rays of a group that can hit anything: they start in a box, go along directions
/// of a box and have no hits behind their origins, or `forward` is false. `away`: how far from
/// there the rays themselves may start, as a sum of coordinates.
struct RayRange {
  BoxAround org, dir;
  double away;
  bool forward;
};

/// The range of rays begin .. end - 1; `begin` is a multiple of W.
BOULE_INLINE RayRange range_of(const PaddedStream& stream, std::size_t begin, std::size_t end) {
  const SharedNumbers& shared = stream.rays().shared;
  VectorRange org, dir;
  RangeLanes tmin;
  for (std::size_t first = begin; first < end; first += width) {
    const auto [rays, at] = stream.packet(first);
    const bool is_first = first == begin;
    if (!shared.has_origin()) org.add(narrow(load_origins(*rays, at)));
    if (is_first || !shared.has_direction()) dir.add(load_directions(*rays, at));
    if (is_first || !shared.has_start()) tmin.add(load(rays->tmin + rays->places(at).start));
  }
  const RayStream& rays = stream.rays();
  const BoxAround from = shared.has_origin()
                             ? BoxAround{{rays.org_x[0], rays.org_y[0], rays.org_z[0]}, {}}
                             : before_rounding(org.box());
  return {from, dir.box(), 0, 0.0F <= least_lane(tmin.low)};
}

BOULE_INLINE double greatest_sum(const BoxAround& box) {
  const auto size = [](double mid, double half) { return (mid < 0 ? -mid : mid) + half; };
  return size(box.mid.x, box.half.x) + size(box.mid.y, box.half.y) + size(box.mid.z, box.half.z);
}

/// The same of the rays turned round: they start at their ends o + d, and have hits before these
/// only. A sum is rounded once.
BOULE_INLINE RayRange backward_range_of(const PaddedStream& stream, std::size_t begin,
                                        std::size_t end) {
  VectorRange ends, dir;
  RangeLanes tmax;
  for (std::size_t first = begin; first < end; first += width) {
    const auto [rays, at] = stream.packet(first);
    const Vec3<Real> d = load_directions(*rays, at);
    ends.add(narrow(load_origins(*rays, at) + widen(d)));
    dir.add(d);
    tmax.add(load(rays->tmax + at));
  }
  BoxAround back = dir.box();
  back.mid = -back.mid;
  return {before_rounding(ends.box()), back, greatest_sum(back), greatest_lane(tmax.high) <= 1.0F};
}

}  // namespace boule::BOULE_KERNEL_ISA
