#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/slabs.h"
#include "simd/kernel/search/leaf/sphere_boxes.h"
#include "simd/kernel/tuning.h"

/// All rays of a packet as one beam, by interval arithmetic: a box that the beam misses is missed
/// by every ray. Tests W boxes, or the boxes of W spheres, at once; the rays test the remaining
/// ones one by one. Chosen for packets whose rays go the same way along at least two axes.
/// docs/numerics.md derives the slack (filter::beam).
namespace boule::BOULE_KERNEL_ISA {

/// Whether all rays go up along an axis, or all down, none of them nearly parallel to its planes.
BOULE_INLINE bool goes_one_way(const Real& unit) {
  return bits(Real(tuning::least_beam_slope) <= unit) == all_lanes ||
         bits(unit <= Real(-tuning::least_beam_slope)) == all_lanes;
}

/// An axis along which all rays go up, or all go down. They cross its plane at x at t >= x
/// near_inverse + near, if the plane is in front of them, and at t <= x far_inverse + far.
struct BeamSlab {
  float near_inverse, near, far_inverse, far;
  float forth;              ///< 1, or -1 if they go down
  std::uint32_t first_row;  ///< offset, in floats, of the planes of a node that rays cross first
  std::uint32_t last_row;   ///< the same for those that they cross last

  /// Returns false if some rays go up and others down, or if some are nearly parallel to the
  /// planes.
  BOULE_INLINE bool set(std::uint32_t axis, const Slab& slab, const Real& org, const Real& unit) {
    const bool down = any(unit <= Real(-tuning::least_beam_slope));
    forth = down ? -1.0F : 1.0F;
    first_row = (down ? axis + 3 : axis) * bvh_width;
    last_row = (down ? axis : axis + 3) * bvh_width;
    near_inverse = near = far_inverse = 0;
    far = static_cast<float>(no_hit);
    if (!goes_one_way(unit)) return false;
    const Real steep = abs(slab.inverse), towards = down ? Real(0.0F) - org : org;
    const float slow = least_lane(steep), fast = greatest_lane(steep);
    const double last = greatest_lane(towards), first = least_lane(towards);
    near_inverse = down ? -slow : slow;
    far_inverse = down ? -fast : fast;
    near = static_cast<float>(-(last + filter::floor) * double{slow});
    far = static_cast<float>((filter::floor - first) * double{fast});
    return true;
  }
  /// Reduces [begin, end] to the part between the first plane and the last.
  BOULE_INLINE void cut(const Real& first, const Real& last, Real& begin, Real& end) const {
    begin = filter_max(filter_fma(first, Real(near_inverse), Real(near)), begin);
    end = filter_min(filter_fma(last, Real(far_inverse), Real(far)), end);
  }
  /// The same for the planes that touch spheres. (r forth is exact: forth is 1 or -1.)
  BOULE_INLINE void cut_around(const Real& center, const Real& r, Real& begin, Real& end) const {
    const Real back = r * Real(forth);
    cut(center - back, center + back, begin, end);
  }
};

/// Whether these rays form a beam: two axes are enough if all rays are judged.
BOULE_INLINE bool forms_beam(const FilterRays& rays) {
  const int axes = (goes_one_way(rays.unit.x) ? 1 : 0) + (goes_one_way(rays.unit.y) ? 1 : 0) +
                   (goes_one_way(rays.unit.z) ? 1 : 0);
  return axes >= 2 && all(is_judged(rays));
}

class Beam {
 public:
  BOULE_INLINE Beam(const BoxRays& rays, const FilterRays& filter, float extent)
      : boxes_(extent), is_beam_(forms_beam(filter)) {
    const bool x = x_.set(0, rays.slabs.x, filter.org.x, filter.unit.x),
               y = y_.set(1, rays.slabs.y, filter.org.y, filter.unit.y),
               z = z_.set(2, rays.slabs.z, filter.org.z, filter.unit.z);
    is_straight_ = is_beam_ && x && y && z;
  }
  /// Whether these rays form a beam. Precondition of all other functions: they do.
  [[nodiscard]] BOULE_INLINE bool is_beam() const { return is_beam_; }
  /// Whether they go the same way along all three axes.
  [[nodiscard]] BOULE_INLINE bool is_straight() const { return is_straight_; }
  /// The rows of a node's planes that a straight beam crosses first, and those that it crosses
  /// last.
  struct Rows {
    const float *first_x, *first_y, *first_z;
    const float *last_x, *last_y, *last_z;
  };
  [[nodiscard]] BOULE_INLINE Rows rows_of(const BvhNode& node) const {
    static_assert(offsetof(BvhNode, max_z) == 5 * bvh_width * sizeof(float));
    const auto* const rows = reinterpret_cast<const float*>(&node);
    return {rows + x_.first_row, rows + y_.first_row, rows + z_.first_row,
            rows + x_.last_row,  rows + y_.last_row,  rows + z_.last_row};
  }

  /// The children of a node that the beam may enter before `limit`, as bits. Writes a lower bound
  /// of each entry distance to `near`.
  BOULE_INLINE unsigned enter(const BvhNode& node, float limit, float* near) const {
    const Rows rows = rows_of(node);
    unsigned in = 0;
    for (std::size_t at = 0; at < bvh_width; at += width) {
      Real begin(0.0F), end(limit);
      x_.cut(load(rows.first_x + at), load(rows.last_x + at), begin, end);
      y_.cut(load(rows.first_y + at), load(rows.last_y + at), begin, end);
      z_.cut(load(rows.first_z + at), load(rows.last_z + at), begin, end);
      store(near + at, begin);
      in |= bits(~is_empty(begin, end)) << at;
    }
    return in;
  }
  /// The spheres of a leaf whose boxes the beam may enter before `limit`, as bits.
  [[nodiscard]] BOULE_INLINE unsigned meet(const SphereBlock& leaf, float limit) const {
    unsigned in = 0;
    for (std::size_t at = 0; at < bvh_leaf_size; at += width) {
      const Real r = boxes_.half_sizes(leaf.radius + at);
      Real begin(0.0F), end(limit);
      x_.cut_around(load(leaf.center_x + at), r, begin, end);
      y_.cut_around(load(leaf.center_y + at), r, begin, end);
      z_.cut_around(load(leaf.center_z + at), r, begin, end);
      in |= bits(~is_empty(begin, end)) << at;
    }
    return in;
  }

 private:
  BeamSlab x_, y_, z_;
  SphereBoxes boxes_;
  bool is_beam_, is_straight_;
};

}  // namespace boule::BOULE_KERNEL_ISA
