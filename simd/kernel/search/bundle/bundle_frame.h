#pragma once

#include "core/math/geometry.h"
#include "simd/kernel/search/bundle/bundle_source.h"

/// The frame of a bundle, O and the axes U, V and W, and the projection of its rays into it. A ray
/// is the line through O along (a, b, 1); with a common direction it is the line along W through
/// (a, b). Lengths along rays are measured by v = t |d|^2 / d.W (with a common direction, v = t
/// |d|). docs/numerics.md bounds the rounding of these numbers.
namespace boule::BOULE_KERNEL_ISA {

/// In world coordinates; the axes have unit length.
struct BundleFrame {
  Vec3d org, u, v, w;
};

/// The frame with W along `forward` and U as near to `side` as possible. NaN if `forward` is 0 or
/// NaN.
BOULE_INLINE BundleFrame make_frame(const Vec3d& org, const Vec3d& forward, const Vec3d& side) {
  const Vec3d w = normalize(forward);
  Vec3d across = side - w * dot(side, w);
  if (!(dot(across, across) > 1e-12 * dot(side, side))) {
    // `side` lies along W or is 0: any axis off W will do.
    const Vec3d axis = __builtin_fabs(w.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    across = axis - w * dot(axis, w);
  }
  across = normalize(across);
  const Vec3d u = normalize(across - w * dot(across, w));
  return {org, u, cross(w, u), w};
}

/// Rays in the frame of their bundle; members as in BundleRays.
struct Projected {
  Real a, b, c, scale, across, shift;
};

/// Brings rays into the frame of their bundle, W at a time.
template <Common common>
class Projection {
 public:
  /// `middle`: the sight along W; with a common direction, that direction.
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
              filter_dot(sight, sight) * inverse, sum_abs(off) * inverse,        ray.shift};
    } else if constexpr (common == Common::end) {
      const Vec3<Real> back{Real(0.0F) - sight.x, Real(0.0F) - sight.y, Real(0.0F) - sight.z};
      const Real inverse = Real(1.0F) / filter_dot(back, w_);
      return {filter_dot(back, u_) * inverse,     filter_dot(back, v_) * inverse, Real(0.0F),
              filter_dot(sight, sight) * inverse, sum_abs(back) * inverse,        ray.shift};
    } else {
      return {filter_dot(sight, u_), filter_dot(sight, v_),
              filter_dot(sight, w_), length_,
              sum_abs(sight),        ray.shift};
    }
  }

 private:
  Vec3<Real> middle_, u_, v_, w_;
  Real length_;
};

BOULE_INLINE bool in_bundle_range(const Vec3d& v) {
  const double limit = double{filter::limit};
  return __builtin_fabs(v.x) < limit && __builtin_fabs(v.y) < limit && __builtin_fabs(v.z) < limit;
}

/// The frame of a bundle, with W along the sight `middle`.
template <Common common, class Source>
BOULE_INLINE BundleFrame frame_of(const Source& source, const Vec3d& middle) {
  // In Morton order, the ray at a third is the corner of the tile that lies along x.
  const Vec3d side = source.one_sight((source.count() - 1) / 3) - source.one_sight(0);
  return make_frame(source.org(), common == Common::end ? -middle : middle, side);
}

}  // namespace boule::BOULE_KERNEL_ISA
