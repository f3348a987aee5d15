#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/capsule.h"
#include "simd/kernel/search/packet/ray_range.h"

/// Groups of rays against up to sixteen capsules or boxes at once, before any ray is loaded: rays
/// that go past the edges of a cell, or past a molecule, thus pay next to nothing for them.
/// docs/numerics.md derives the bound.
namespace boule::BOULE_KERNEL_ISA {

/// The capsules of a geometry, if they are at most sixteen; otherwise the boxes of the root of
/// their tree.
class CapsulesNear {
 public:
  static constexpr unsigned all = 0xffff;

  explicit CapsulesNear(const CapsuleView& capsules)
      : few_(capsules.slots == bvh_leaf_size), known_(few_ || capsules.scanned == 0) {
    if (few_) {
      add_block(capsules.blocks[0], capsules.id);
    } else if (known_) {
      add_boxes(capsules.bvh.nodes[0]);
    }
  }

  /// Whether find() gives the slots of capsules.
  [[nodiscard]] bool few() const { return few_; }

  /// Those that rays begin .. end - 1 of a stream may hit, as bits: all, unless the rays share
  /// origins or directions. (With boxes of origins, shadow rays among a million spheres met nearly
  /// all, and paid for it.) `begin` is a multiple of W.
  [[nodiscard]] BOULE_INLINE unsigned find(const PaddedStream& stream, std::size_t begin,
                                           std::size_t end) const {
    const SharedNumbers& shared = stream.rays().shared;
    if (!known_ || !(shared.has_origin() || shared.has_direction())) return all;
    const RayRange rays = range_of(stream, begin, end);
    if (!rays.forward) return all;
    unsigned out = 0;
    for (int at = 0; at < size_; at += width) out |= find_missed(rays, at) << at;
    return ~out & ((1U << size_) - 1);
  }

 private:
  void add_block(const CapsuleBlock& block, const std::int32_t* id) {
    for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
      const bool there = id[k] >= 0;
      if (there) size_ = static_cast<int>(k) + 1;
      const auto set = [k, there](Axis& axis, const float* from, const float* to) {
        axis.a[k] = there ? double{from[k]} : 0;
        axis.u[k] = there ? double{to[k]} - double{from[k]} : 0;
        axis.half[k] = 0;
      };
      set(x_, block.a_x, block.b_x);
      set(y_, block.a_y, block.b_y);
      set(z_, block.a_z, block.b_z);
      radius_[k] = there ? double{block.radius[k]} : 0;
    }
  }
  void add_boxes(const BvhNode& node) {
    size_ = node.size;
    for (int k = 0; k < bvh_width; ++k) {
      const bool there = k < size_;
      const auto set = [k, there](Axis& axis, const float* low, const float* high) {
        axis.a[k] = there ? (double{low[k]} + double{high[k]}) / 2 : 0;
        axis.u[k] = 0;
        axis.half[k] = there ? (double{high[k]} - double{low[k]}) / 2 : 0;
      };
      set(x_, node.min_x, node.max_x);
      set(y_, node.min_y, node.max_y);
      set(z_, node.min_z, node.max_z);
      radius_[k] = 0;
    }
  }

  /// Those among W bodies from `at` on that all rays certainly miss: a plane has the body on one
  /// side and the rays on the other. The plane looks from the middle ray to the point of the
  /// segment that is nearest to it, and leans towards the ray's direction by as much as the
  /// directions spread.
  [[nodiscard]] BOULE_INLINE unsigned find_missed(const RayRange& rays, int at) const {
    const Vec3<Wide> c{rays.dir.mid.x, rays.dir.mid.y, rays.dir.mid.z};
    const Vec3<Wide> spread{rays.dir.half.x, rays.dir.half.y, rays.dir.half.z};
    const Vec3<Wide> start{rays.org.half.x, rays.org.half.y, rays.org.half.z};
    const Vec3<Wide> org{rays.org.mid.x, rays.org.mid.y, rays.org.mid.z};
    const Wide zero(0.0), cc = dot(c, c), per_cc = Wide(1.0) / cc;
    const Vec3<Wide> f = Vec3<Wide>{load(x_.a + at), load(y_.a + at), load(z_.a + at)} - org;
    const Vec3<Wide> u{load(x_.u + at), load(y_.u + at), load(z_.u + at)};
    const Vec3<Wide> half{load(x_.half + at), load(y_.half + at), load(z_.half + at)};
    const Wide radius = abs(load(radius_ + at));
    const Vec3<Wide> l = f - c * (dot(f, c) * per_cc), v = u - c * (dot(u, c) * per_cc);
    const Vec3<Wide> n = l + v * on_segment(zero - dot(l, v) / dot(v, v));
    const Wide beyond = dot(n, c) + dot(absolute(n), spread), least = cc - dot(absolute(c), spread);
    const Wide lean = select(zero < beyond, beyond / least, zero);
    const Vec3<Wide> m = n - c * lean;
    const Wide from_a = dot(f, m), from_b = from_a + dot(u, m);
    const Wide nearest = select(from_b < from_a, from_b, from_a);
    const Wide slack = Wide(filter::aside) * (sum_abs(n) + sum_abs(c) * lean) *
                       (sum_abs(f) + sum_abs(u) + radius + sum_abs(half + start));
    const Wide reach = radius * sqrt(dot(m, m)) + dot(absolute(m), half + start) + slack;
    return bits((zero < least) & (reach < nearest));
  }
  BOULE_INLINE static Vec3<Wide> absolute(const Vec3<Wide>& v) {
    return {abs(v.x), abs(v.y), abs(v.z)};
  }

  /// One coordinate of each body: all points within the radius, or within a box of this half size,
  /// around the points a + s u, 0 <= s <= 1.
  struct Axis {
    alignas(64) double a[bvh_leaf_size], u[bvh_leaf_size], half[bvh_leaf_size];
  };

  Axis x_, y_, z_;
  alignas(64) double radius_[bvh_leaf_size];
  int size_ = 0;
  bool few_, known_;
};

}  // namespace boule::BOULE_KERNEL_ISA
