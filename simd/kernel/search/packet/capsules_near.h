#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/capsule.h"
#include "simd/kernel/search/packet/ray_range.h"

/// Groups of rays against capsules, and against the boxes of the root of their tree, before any ray
/// is loaded: rays that go past the edges of a cell, or past a molecule, thus pay next to nothing
/// for them. docs/numerics.md derives the bound.
namespace boule::BOULE_KERNEL_ISA {

/// The capsules that the rays of a group may hit.
struct NearCapsules {
  bool any = true;      ///< whether there are any
  bool listed = false;  ///< whether all of them are in the list
  int size = 0;
  std::uint32_t slot[tuning::most_capsules_alone];

  /// Adds those of W slots whose bit is set; `listed` ends where there is no room for them.
  BOULE_INLINE void add(std::size_t first_slot, unsigned bits) {
    for (; bits != 0 && listed; bits &= bits - 1) {
      listed = size < tuning::most_capsules_alone;
      if (listed)
        slot[size++] = static_cast<std::uint32_t>(first_slot) +
                       static_cast<std::uint32_t>(__builtin_ctz(bits));
    }
  }
};

/// At most sixteen capsules, as rays see them that share their origin or their end, the apex: each
/// spans a triangle with it, and a ray that hits the capsule leaves the plane of that triangle at a
/// small angle only.
class CapsuleWedges {
 public:
  /// As seen by the rays of a stream, if they have an apex.
  CapsuleWedges(const CapsuleView& capsules, const RayStream& rays, Coherence coherence)
      : one_end_(coherence == Coherence::common_end) {
    if (capsules.slots != bvh_leaf_size || rays.size == 0) return;
    if (!one_end_ && !rays.shared.has_origin()) return;
    const Ray ray = get_ray(rays, 0);
    const Vec3d dir = vec_cast<double>(ray.dir);
    apex_ = one_end_ ? ray.org + dir : ray.org;
    for (std::size_t k = 0; k < bvh_leaf_size; ++k)
      if (capsules.id[k] >= 0) add(capsules.blocks[0], k);
  }

  [[nodiscard]] bool known() const { return size_ != 0; }
  /// The rays among `lanes` of the packet at `first` that may hit a capsule; adds those capsules.
  [[nodiscard]] BOULE_INLINE unsigned find(const PaddedStream& stream, std::size_t first,
                                           unsigned lanes, NearCapsules& near) const {
    const auto [rays, at] = stream.packet(first);
    const Vec3<Real> d = load_directions(*rays, at);
    const Real dd = filter_dot(d, d);
    // Squares that may be inexact, and lines that miss the apex, are not judged.
    RealMask judged = (Real(0x1p-80F) < dd) & (dd < Real(0x1p80F));
    if (one_end_) {
      const Vec3<Wide> end = load_origins(*rays, at) + widen(d);
      const Vec3<Wide> apex{apex_.x, apex_.y, apex_.z};
      judged = judged & (sum_abs(narrow(end - apex)) < Real(off_apex_)) &
               (sum_abs(d) < Real(off_apex_ * 0x1p38F));  // else the sum may be inexact
    }
    unsigned found = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      const Real along = filter_dot(d, {Real(x_[k]), Real(y_[k]), Real(z_[k])});
      const unsigned in = lanes & ~bits(judged & (Real(square_[k]) * dd < along * along));
      if (in != 0) near.add(slot_[k], 1);
      found |= in;
    }
    return found;
  }

 private:
  void add(const CapsuleBlock& block, std::size_t k) {
    const Vec3d a{block.a_x[k], block.a_y[k], block.a_z[k]};
    const Vec3d u = Vec3d{block.b_x[k], block.b_y[k], block.b_z[k]} - a, f = a - apex_;
    const double radius = __builtin_fabs(double{block.radius[k]}), uu = dot(u, u);
    const double place = -dot(f, u) / uu;  // of the nearest point; NaN: the segment is a point
    const Vec3d nearest = f + u * (place < 0 ? 0.0 : place < 1 ? place : 1.0);
    const double away = __builtin_sqrt(dot(nearest, nearest)) - radius, off = away * 0x1p-14;
    const Vec3d normal = cross(f, u);
    const double nn = dot(normal, normal);
    const double coordinates = sum(a) + sum(apex_) + sum(u);
    const bool good = 0x1p-38 * coordinates < off && 0x1p-40 * dot(f, f) * uu < nn &&
                      nn < 0x1p200 && 0x1p-200 < nn;
    slot_[size_] = k;
    const double scale = good ? 1 / __builtin_sqrt(nn) : 0.0;
    x_[size_] = static_cast<float>(normal.x * scale);
    y_[size_] = static_cast<float>(normal.y * scale);
    z_[size_] = static_cast<float>(normal.z * scale);
    const double sine = (radius + off) / (away - off) + 0x1p-19;
    square_[size_] = good && sine < 1 ? static_cast<float>(sine * sine * (1 + 0x1p-20)) : 2.0F;
    if (good && off < static_cast<double>(off_apex_)) off_apex_ = static_cast<float>(off * 0.99);
    ++size_;
  }
  static double sum(const Vec3d& v) {
    return __builtin_fabs(v.x) + __builtin_fabs(v.y) + __builtin_fabs(v.z);
  }

  bool one_end_;
  std::size_t size_ = 0;
  Vec3d apex_{};
  float off_apex_ = 1e30F;  ///< lines may miss the apex by this
  float x_[bvh_leaf_size], y_[bvh_leaf_size], z_[bvh_leaf_size];  ///< the normals of the planes
  float square_[bvh_leaf_size];  ///< of the sine of the largest angle
  std::size_t slot_[bvh_leaf_size];
};

/// The capsules of a geometry, if they are at most sixteen, or the children of the root of their
/// tree.
class CapsulesNear {
 public:
  explicit CapsulesNear(const CapsuleView& capsules)
      : capsules_(capsules),
        few_(capsules.slots == bvh_leaf_size),
        known_(few_ || capsules.scanned == 0) {
    for (std::size_t k = 0; few_ && k < bvh_leaf_size; ++k)
      if (capsules.id[k] >= 0) size_of_few_ = k + 1;
  }

  [[nodiscard]] const CapsuleView& view() const { return capsules_; }
  /// Those that rays begin .. end - 1 of a stream may hit: any, unless the rays share origins,
  /// directions or ends. (With boxes of origins, shadow rays among a million spheres met nearly
  /// all, and paid for it.) `begin` is a multiple of W.
  [[nodiscard]] BOULE_INLINE NearCapsules find(const PaddedStream& stream, Coherence coherence,
                                               std::size_t begin, std::size_t end) const {
    NearCapsules near;
    const SharedNumbers& shared = stream.rays().shared;
    const bool one_end = coherence == Coherence::common_end;
    if (!known_ || !(shared.has_origin() || shared.has_direction() || one_end)) return near;
    const RayRange rays =
        one_end ? backward_range_of(stream, begin, end) : range_of(stream, begin, end);
    if (!rays.forward) return near;
    near.listed = true;
    if (few_) {
      add_leaf(rays, 0, size_of_few_, near);
    } else {
      add_children(rays, capsules_.bvh.nodes[0], near);
    }
    near.any = !near.listed || near.size > 0;
    return near;
  }

 private:
  /// All points within the radius, or within a box of this half size, around the points a + s u,
  /// 0 <= s <= 1: W of them.
  struct Bodies {
    Vec3<Wide> a, u, half;
    Wide radius;
  };

  BOULE_INLINE static Bodies capsules_at(const CapsuleBlock& block, std::size_t at) {
    const auto of = [at](const float* x, const float* y, const float* z) {
      return widen(Vec3<Real>{load(x + at), load(y + at), load(z + at)});
    };
    const Vec3<Wide> a = of(block.a_x, block.a_y, block.a_z);
    const Wide zero(0.0);
    return {a,
            of(block.b_x, block.b_y, block.b_z) - a,
            {zero, zero, zero},
            widen(abs(load(block.radius + at)))};
  }
  BOULE_INLINE static Bodies boxes_at(const BvhNode& node, std::size_t at) {
    const auto of = [at](const float* x, const float* y, const float* z) {
      return widen(Vec3<Real>{load(x + at), load(y + at), load(z + at)});
    };
    const Vec3<Wide> low = of(node.min_x, node.min_y, node.min_z);
    const Vec3<Wide> high = of(node.max_x, node.max_y, node.max_z);
    const Wide zero(0.0), half(0.5);
    return {(low + high) * half, {zero, zero, zero}, (high - low) * half, zero};
  }

  BOULE_INLINE void add_leaf(const RayRange& rays, std::size_t first_slot, std::size_t size,
                             NearCapsules& near) const {
    const CapsuleBlock& block = capsules_.blocks[first_slot / bvh_leaf_size];
    for (std::size_t at = 0; at < size && near.listed; at += width) {
      const unsigned missed = find_missed(rays, capsules_at(block, at));
      near.add(first_slot + at, ~missed & first_lanes(size - at));
    }
  }
  /// Nodes below the root are not looked into: the capsules are too many for a list.
  BOULE_INLINE void add_children(const RayRange& rays, const BvhNode& root,
                                 NearCapsules& near) const {
    const std::size_t size = root.size;
    for (std::size_t at = 0; at < size && near.listed; at += width) {
      unsigned met = ~find_missed(rays, boxes_at(root, at)) & first_lanes(size - at);
      for (; met != 0 && near.listed; met &= met - 1) {
        const std::size_t child = at + static_cast<std::size_t>(__builtin_ctz(met));
        near.listed = root.leaf_size[child] != 0;
        if (!near.listed) return;
        add_leaf(rays, capsules_.scanned + index_of(root.child[child]) * bvh_leaf_size,
                 root.leaf_size[child], near);
      }
    }
  }

  /// Those among W bodies that all rays certainly miss, as bits: a plane has the body on one side
  /// and the rays on the other. The plane looks from the middle ray to the point of the segment
  /// that is nearest to it, and leans towards the ray's direction by as much as the directions
  /// spread.
  [[nodiscard]] BOULE_INLINE static unsigned find_missed(const RayRange& rays,
                                                         const Bodies& bodies) {
    const Vec3<Wide> c{rays.dir.mid.x, rays.dir.mid.y, rays.dir.mid.z};
    const Vec3<Wide> spread{rays.dir.half.x, rays.dir.half.y, rays.dir.half.z};
    const Vec3<Wide> start{rays.org.half.x, rays.org.half.y, rays.org.half.z};
    const Vec3<Wide> org{rays.org.mid.x, rays.org.mid.y, rays.org.mid.z};
    const Wide zero(0.0), cc = dot(c, c), per_cc = Wide(1.0) / cc;
    const Vec3<Wide> f = bodies.a - org;
    const Vec3<Wide>&u = bodies.u, &half = bodies.half;
    const Vec3<Wide> l = f - c * (dot(f, c) * per_cc), v = u - c * (dot(u, c) * per_cc);
    const Vec3<Wide> n = l + v * on_segment(zero - dot(l, v) / dot(v, v));
    const Wide beyond = dot(n, c) + dot(absolute(n), spread), least = cc - dot(absolute(c), spread);
    const Wide lean = select(zero < beyond, beyond / least, zero);
    const Vec3<Wide> m = n - c * lean;
    const Wide from_a = dot(f, m), from_b = from_a + dot(u, m);
    const Wide nearest = select(from_b < from_a, from_b, from_a);
    const Wide slack =
        Wide(filter::aside) * (sum_abs(n) + sum_abs(c) * lean) *
        (sum_abs(f) + sum_abs(u) + bodies.radius + sum_abs(half + start) + Wide(rays.away));
    const Wide reach = bodies.radius * sqrt(dot(m, m)) + dot(absolute(m), half + start) + slack;
    return bits((zero < least) & (reach < nearest));
  }
  BOULE_INLINE static Vec3<Wide> absolute(const Vec3<Wide>& v) {
    return {abs(v.x), abs(v.y), abs(v.z)};
  }

  const CapsuleView& capsules_;
  const bool few_, known_;
  std::size_t size_of_few_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
