#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/geometry.h"
#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/packet/tree_blocks.h"

/// One ray by itself in a tree, W children or W spheres at a time: chosen for streams that are to
/// go as single rays, where float can judge the ray and it has no hits behind its origin. It takes
/// the steps of a flight (flight.h), with a stack of its own, because nothing else runs while it
/// waits. Float rejects spheres or shortens the ray. The few spheres that may be hit before its end
/// are solved in double, one after the other.
namespace boule::BOULE_KERNEL_ISA {

class LoneRay {
 public:
  BOULE_INLINE LoneRay(const GeometryView& geometry, const Ray& ray)
      : spheres_(geometry.spheres),
        nodes_(geometry.bvh.nodes),
        leaves_(spheres_.blocks + spheres_.scanned / bvh_leaf_size),
        org_(ray.org),
        dir_(vec_cast<double>(ray.dir)),
        tmin_(ray.tmin),
        source_(ray.source),
        inside_(ray.inside) {
    constexpr double largest{std::numeric_limits<float>::max()};
    tmax_ = largest < ray.tmax ? largest : ray.tmax;
    a_ = dot(dir_, dir_);
    inverse_a_ = 1.0 / a_;
    length_ = __builtin_sqrt(a_);
    make_filter();
    set_slabs(geometry.bvh.extent);
    rows_.choose(ray_);
  }

  /// Whether float can judge the ray, and it has no hits behind its origin.
  [[nodiscard]] BOULE_INLINE bool may() const {
    constexpr float limit = filter::limit;
    const bool is_small = __builtin_fabsf(ray_.org[0]) < limit &&
                          __builtin_fabsf(ray_.org[1]) < limit &&
                          __builtin_fabsf(ray_.org[2]) < limit;
    return is_small && ray_.unit[0] == ray_.unit[0] && !(tmin_ < 0);
  }
  /// The largest t |dir| that counts.
  [[nodiscard]] BOULE_INLINE float end() const { return static_cast<float>(tmax_ * length_); }

  /// Finds the nearest hit in the tree before `hit`, the nearest one so far. `reach`: the largest
  /// t |dir| that counts.
  BOULE_INLINE void find_nearest(float reach, Hit& hit) {
    ray_.reach = reach;
    traverse<false>(hit);
    solve(hit);
  }
  /// Whether the ray meets a sphere of the tree before `reach`.
  [[nodiscard]] BOULE_INLINE bool find_any(float reach) {
    ray_.reach = reach;
    Hit hit;
    return traverse<true>(hit);
  }

 private:
  static constexpr std::size_t parts = bvh_width / width;
  static_assert(bvh_width == bvh_leaf_size);
  static constexpr std::size_t room = bvh_max_depth * (bvh_width - 1) + 1;

  /// The formulas of make_filter() (ray_lanes.h) for one ray.
  BOULE_INLINE void make_filter() {
    const double inverse_length = length_ * inverse_a_,
                 error_of = 1 + 2 * filter::slack * filter::u;
    const double longer = inverse_length * (1 + filter::slack / 2 * filter::u);
    const double org[]{org_.x, org_.y, org_.z}, dir[]{dir_.x, dir_.y, dir_.z};
    double error = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ray_.org[axis] = static_cast<float>(org[axis]);
      error += __builtin_fabs(org[axis] - double{ray_.org[axis]});
      ray_.unit[axis] = static_cast<float>(dir[axis] * inverse_length);
      ray_.h[axis] = static_cast<float>(dir[axis] * longer);
    }
    ray_.origin_error = static_cast<float>(error * error_of + filter::floor);
    constexpr float largest = std::numeric_limits<float>::max();
    const float far = static_cast<float>(tmax_ * length_);
    ray_.live_from = static_cast<float>(tmin_ * length_);
    ray_.live_to = largest < far ? largest : far;
  }
  /// The formulas of Slab (slabs.h) for one ray.
  BOULE_INLINE void set_slabs(float extent) {
    constexpr auto least = static_cast<float>(filter::slab_least);
    constexpr auto beside = static_cast<float>(4 * filter::slab_least);
    const float farthest = __builtin_fabsf(ray_.org[0]) + __builtin_fabsf(ray_.org[1]) +
                           __builtin_fabsf(ray_.org[2]) + extent;
    const double org[]{org_.x, org_.y, org_.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float size = __builtin_fabsf(ray_.unit[axis]);
      const bool tiny = size < least;
      const float steep = 1.0F / (tiny ? least : size);
      ray_.inverse[axis] = ray_.unit[axis] < 0 ? -steep : steep;
      const float aside = tiny ? farthest * beside : 0.0F;
      const double at = org[axis] * double{ray_.inverse[axis]};
      const double slack = (double{aside} + filter::floor) * double{steep};
      ray_.near[axis] = static_cast<float>(0.0 - at - slack);
      ray_.far[axis] = static_cast<float>(slack - at);
    }
  }

  /// Visits the leaves that the ray enters, near children first. Returns true, for any hit, where
  /// it meets a sphere.
  template <bool any_hit>
  BOULE_INLINE bool traverse(Hit& hit) {
    std::size_t waiting = 0;
    std::uint32_t next = 0;
    for (;;) {
      if ((next & leaf_bit) == 0) {
        if (enter(nodes_[next], next, waiting)) continue;
      } else {
        const bool met = list_hits(index_of(next));
        if constexpr (any_hit) {
          if (met) return true;
          if (candidates_.size != 0) {
            const float reach = ray_.reach;
            solve(hit);
            if (hit.id != no_primitive) return true;
            ray_.reach = reach;
          }
        } else if (candidates_.size > FlightCandidates::most) {
          solve(hit);
        }
      }
      do {
        if (waiting == 0) return false;
        --waiting;
      } while (ray_.reach < waiting_[waiting].near());
      next = waiting_[waiting].child();
    }
  }
  /// A child, and a lower bound, at least 0, of the distance at which it is entered.
  struct Waiting {
    std::uint64_t order;

    [[nodiscard]] BOULE_INLINE float near() const {
      return std::bit_cast<float>(static_cast<std::uint32_t>(order >> 32));
    }
    [[nodiscard]] BOULE_INLINE std::uint32_t child() const {
      return static_cast<std::uint32_t>(order);
    }
  };
  BOULE_INLINE static void sort(Waiting& far, Waiting& near) {
    const bool swap = far.order < near.order;
    const std::uint64_t less = swap ? far.order : near.order;
    far.order = swap ? near.order : far.order;
    near.order = less;
  }
  /// Sets `next` to the nearest child of a node that the ray enters, and lets the others wait.
  /// Returns false if there is none.
  BOULE_INLINE bool enter(const BvhNode& node, std::uint32_t& next, std::size_t& waiting) {
    alignas(64) float near[bvh_width];
    unsigned in = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const Passage passage = enter_children(ray_, rows_, node, part * width);
      store(near + part * width, passage.near);
      in |= bits(passage.in) << part * width;
    }
    if (in == 0) return false;
    const auto take = [&] {
      const int k = std::countr_zero(in);
      in &= in - 1;
      return Waiting{std::uint64_t{std::bit_cast<std::uint32_t>(near[k])} << 32 | node.child[k]};
    };
    Waiting nearest = take();
    if (in != 0) {
      Waiting second = take();
      sort(second, nearest);
      if (in != 0) {
        Waiting third = take();
        sort(third, second);
        sort(second, nearest);
        const std::size_t base = waiting;
        waiting_[waiting++] = third;
        while (in != 0) {
          Waiting other = take();
          sort(other, second);
          sort(second, nearest);
          std::size_t at = waiting++;
          for (; at > base && waiting_[at - 1].order < other.order; --at)
            waiting_[at] = waiting_[at - 1];
          waiting_[at] = other;
        }
      }
      waiting_[waiting++] = second;
    }
    next = nearest.child();
    return true;
  }

  /// Makes the spheres of a leaf that may be hit candidates, and ends the reach behind those that
  /// certainly are. Returns whether one certainly is before the end of the ray.
  BOULE_INLINE bool list_hits(std::uint32_t index) {
    const SphereBlock& leaf = leaves_[index];
    const std::uint32_t slot = static_cast<std::uint32_t>(spheres_.scanned) +
                               index * static_cast<std::uint32_t>(bvh_leaf_size);
    bool sure = false;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t at = part * width;
      const Vec3<Real> center{load(leaf.center_x + at), load(leaf.center_y + at),
                              load(leaf.center_z + at)};
      const Real radius = load(leaf.radius + at);
      const RealMask may = RejectSpheres(center, radius)
                               .may_meet(FlightRay::all(ray_.org), FlightRay::all(ray_.h),
                                         ray_.origin_error, ray_.reach);
      const std::uint32_t first = slot + static_cast<std::uint32_t>(at);
      RealMask own = uniform(false);
      if (source_ != no_primitive) own = load_integers(spheres_.id + first) == Bits(source_);
      // The ray hits its own sphere again only if it leaves it on its inside; only double can find
      // the hit.
      if (inside_ && any(own))
        candidates_.add(Real(-static_cast<float>(no_hit)), count_from(first), bits(own));
      if (!any(may & ~own)) continue;
      const FilterRays rays = ray_.filter();
      const NextRoots roots(find_approach(rays, center, radius), rays, Real(ray_.reach), own);
      candidates_.add(roots.low, count_from(first), bits(roots.in));
      const Real none(static_cast<float>(no_hit));
      const float high = least_lane(lesser_or(select(roots.sure, roots.high, none), none));
      sure = sure || high <= ray_.live_to;
      if (high < ray_.reach) ray_.reach = high;
    }
    return sure;
  }

  /// Solves the candidates that may be nearest. A hit ends the reach: float bounds may be too
  /// loose, as very far from a sphere.
  BOULE_INLINE void solve(Hit& hit) {
    for (unsigned k = 0; k < candidates_.size; ++k) {
      if (candidates_.low[k] <= ray_.reach) solve(candidates_.slot[k], hit);
    }
    candidates_.size = 0;
  }
  /// solve_robust() of one ray and one sphere: the same bits.
  BOULE_INLINE void solve(std::uint32_t slot, Hit& hit) {
    const SlotSphere sphere = get_slot(spheres_, slot);
    const std::int32_t id = id_of(spheres_, slot);
    const Vec3d f = Vec3d{double{sphere.x}, double{sphere.y}, double{sphere.z}} - org_;
    const double r = double{sphere.radius}, rr = r * r, b = dot(f, dir_);
    double t = 0;
    if (id == source_) {
      t = (b + b) * inverse_a_;
      if (!inside_ || !holds(t)) return;
    } else {
      const Vec3d l = f - dir_ * (b * inverse_a_);
      const double discriminant = rr - dot(l, l);
      if (!(0 <= discriminant)) return;
      const double q = b + __builtin_copysign(__builtin_sqrt(a_ * discriminant), b);
      const double from_a = q * inverse_a_;
      const double from_cc = 0 < discriminant ? (dot(f, f) - rr) / q : from_a;
      const bool ordered = from_cc < from_a;
      t = ordered ? from_cc : from_a;
      if (!holds(t)) t = ordered ? from_a : from_cc;
      if (!holds(t)) return;
    }
    if (!(t < hit.t || (t == hit.t && is_lower(id, hit.id)))) return;
    hit = {t, id, slot};
    const auto solved = static_cast<float>(t * length_);
    if (solved < ray_.reach) ray_.reach = solved;
  }
  [[nodiscard]] BOULE_INLINE bool holds(double t) const { return tmin_ < t && t <= tmax_; }

  const SphereView& spheres_;
  const BvhNode* nodes_;
  const SphereBlock* leaves_;
  Vec3d org_, dir_;
  double tmin_, tmax_, a_, inverse_a_, length_;
  std::int32_t source_;
  bool inside_;
  FlightRay ray_;
  NodeRows rows_;
  FlightCandidates candidates_;
  Waiting waiting_[room];
};

}  // namespace boule::BOULE_KERNEL_ISA
