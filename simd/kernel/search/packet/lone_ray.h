#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/geometry.h"
#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/packet/parts.h"
#include "simd/kernel/search/packet/tree_blocks.h"

/// One ray by itself in a tree, W children or W spheres at a time: chosen for streams that are to
/// go as single rays, where float can judge the ray and it has no hits behind its origin. It takes
/// the steps of a flight (flight.h), with a stack of its own, because nothing else runs while it
/// waits. Float rejects spheres or shortens the ray. The few spheres that may be hit before its end
/// are solved in double, one after the other.
namespace boule::BOULE_KERNEL_ISA {

/// W rays of a stream, prepared together.
class LonePacket {
 public:
  /// `first`: a multiple of W. `extent`: BvhView::extent.
  BOULE_NOINLINE void load(const PaddedStream& stream, std::size_t first, float extent) {
    const PacketRef packet = stream.packet(first);
    RayLanes rays;
    load_packet(*packet.rays, packet.first, rays);
    store(a_, rays.exact.a);
    store(inverse_a_, rays.exact.inverse_a);
    store(tmax_, rays.exact.tmax);
    store(length_, rays.filter.length);
    rows_.set(rays, extent, rays.filter.live_to);
    judged_ = bits(is_judged(rays.filter));
  }

 private:
  friend class LoneRay;

  FlightRows rows_;
  alignas(64) double a_[width], inverse_a_[width], tmax_[width], length_[width];
  unsigned judged_;
};

class LoneRay {
 public:
  /// Whether a geometry has a tree that float can judge.
  BOULE_INLINE static bool suits(const GeometryView& geometry) {
    return geometry.bvh.size != 0 && geometry.bvh.extent < filter::limit;
  }
  /// Whether there are spheres outside the tree, or planes.
  BOULE_INLINE static bool leaves_others(const GeometryView& geometry) {
    return geometry.spheres.scanned != 0 || geometry.planes.size != 0;
  }
  BOULE_INLINE static bool leaves_others(const PartsGeometry& /*geometry*/) { return true; }

  BOULE_INLINE LoneRay(const GeometryView& geometry, const Ray& ray) : LoneRay(geometry) {
    set(ray);
    finish(exact_);
    FilterRay filter;
    make_filter(exact_, filter);
    const auto [x, y, z] = slabs_of(exact_, filter, geometry.bvh.extent);
    const auto& [org, h, unit, error, exact, length, inverse, from, to, below] = filter;
    ray_ = {{x.inverse, y.inverse, z.inverse},
            to,
            {x.near, y.near, z.near},
            from,
            {x.far, y.far, z.far},
            to,
            {org.x, org.y, org.z},
            error,
            {unit.x, unit.y, unit.z},
            unit.z,
            {h.x, h.y, h.z},
            h.z};
    length_ = length;
    judged_ = is_judged(filter);
    rows_.choose(ray_);
  }
  /// The ray of a lane of a packet.
  BOULE_INLINE LoneRay(const GeometryView& geometry, const Ray& ray, const LonePacket& packet,
                       std::size_t lane)
      : LoneRay(geometry) {
    set(ray);
    exact_.a = packet.a_[lane];
    exact_.inverse_a = packet.inverse_a_[lane];
    exact_.tmax = packet.tmax_[lane];
    packet.rows_.get(lane, ray_);
    length_ = packet.length_[lane];
    judged_ = (packet.judged_ >> lane & 1U) != 0;
    rows_.choose(ray_);
  }

  /// Whether float can judge the ray, and it has no hits behind its origin.
  [[nodiscard]] BOULE_INLINE bool may() const { return judged_; }
  /// The largest t |dir| that counts.
  [[nodiscard]] BOULE_INLINE float end() const { return static_cast<float>(exact_.tmax * length_); }

  /// Finds the nearest hit in the tree before `hit`, the nearest one so far. `reach`: the largest
  /// t |dir| that counts.
  BOULE_INLINE void find_nearest(float reach, Hit& hit) {
    ray_.reach = reach;
    Nearest nearest{hit};
    traverse(nearest);
    solve(hit);
  }
  /// Whether the ray meets a sphere of the tree before `reach`.
  [[nodiscard]] BOULE_INLINE bool find_any(float reach) {
    ray_.reach = reach;
    Any any;
    return traverse(any);
  }
  /// Calls add(enter, leave, id, slot) for the chords of the tree's spheres that have a part
  /// between tmin and tmax, in any order, until it returns true.
  template <class Add>
  BOULE_INLINE void find_chords(const GeometryView& geometry, const Add& add) {
    ray_.reach = end();
    All<Add> all{add, TreeBlocks(geometry)};
    traverse(all);
  }

 private:
  BOULE_INLINE explicit LoneRay(const GeometryView& geometry)
      : spheres_(geometry.spheres),
        nodes_(geometry.bvh.nodes),
        leaves_(spheres_.blocks + spheres_.scanned / bvh_leaf_size) {}
  BOULE_INLINE void set(const Ray& ray) {
    exact_.org = ray.org;
    exact_.dir = vec_cast<double>(ray.dir);
    exact_.tmin = ray.tmin;
    exact_.tmax = ray.tmax;
    exact_.source = ray.source;
    exact_.inside = ray.inside;
  }

  static constexpr std::size_t parts = bvh_width / width;
  static_assert(bvh_width == bvh_leaf_size);
  static constexpr std::size_t room = bvh_max_depth * (bvh_width - 1) + 1;

  /// Visits the leaves that the ray enters, near children first, until one says that it is enough:
  /// Ask::visit(*this, leaf). Returns whether one did.
  template <class Ask>
  BOULE_INLINE bool traverse(Ask& ask) {
    std::size_t waiting = 0;
    std::uint32_t next = 0;
    for (;;) {
      if ((next & leaf_bit) == 0) {
        if (enter(ask, nodes_[next], next, waiting)) continue;
      } else if (ask.visit(*this, index_of(next))) {
        return true;
      }
      do {
        if (waiting == 0) return false;
        --waiting;
      } while (ray_.reach < waiting_[waiting].near());
      next = waiting_[waiting].child();
    }
  }
  /// The nearest hit.
  struct Nearest {
    static constexpr bool ordered = true;
    Hit& hit;
    BOULE_INLINE bool visit(LoneRay& ray, std::uint32_t leaf) {
      ray.list_hits(leaf);
      if (ray.candidates_.size > FlightCandidates::most) ray.solve(hit);
      return false;
    }
  };
  /// Any hit.
  struct Any {
    static constexpr bool ordered = true;
    Hit hit;
    BOULE_INLINE bool visit(LoneRay& ray, std::uint32_t leaf) {
      if (ray.list_hits(leaf)) return true;
      if (ray.candidates_.size == 0) return false;
      const float reach = ray.ray_.reach;
      ray.solve(hit);
      ray.ray_.reach = reach;
      return hit.id != no_primitive;
    }
  };
  /// Every chord: add(enter, leave, id, slot), which returns whether there is no more room.
  template <class Add>
  struct All {
    static constexpr bool ordered = false;
    const Add& add;
    TreeBlocks blocks;
    BOULE_INLINE bool visit(LoneRay& ray, std::uint32_t leaf) {
      for (std::size_t part = 0; part < parts; ++part) {
        const LeafPart spheres = ray.get_part(leaf, part);
        RealMask may = ray.may_meet(spheres);
        if (ray.exact_.source != no_primitive) may = may | spheres.own;
        for (unsigned in = bits(may); in != 0; in &= in - 1) {
          const auto slot = spheres.first + static_cast<std::uint32_t>(std::countr_zero(in));
          if (ray.add_chord(slot, add)) return true;
        }
      }
      return false;
    }
  };

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
  /// Returns false if there is none. Where all children will be visited, their order is theirs, and
  /// their memory is fetched at once.
  template <class Ask>
  BOULE_INLINE bool enter(const Ask& ask, const BvhNode& node, std::uint32_t& next,
                          std::size_t& waiting) {
    alignas(64) float near[bvh_width];
    unsigned in = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const Passage passage = enter_children(ray_, rows_, node, part * width);
      store(near + part * width, passage.near);
      in |= bits(passage.in) << part * width;
    }
    if (in == 0) return false;
    const auto take = [&near, &node](unsigned& left) {
      const int k = std::countr_zero(left);
      left &= left - 1;
      return Waiting{std::uint64_t{std::bit_cast<std::uint32_t>(near[k])} << 32 | node.child[k]};
    };
    if constexpr (!Ask::ordered) {
      while ((in & (in - 1)) != 0) {
        waiting_[waiting] = take(in);
        ask.blocks.fetch(waiting_[waiting++].child());
      }
      next = take(in).child();
      return true;
    }
    Waiting nearest = take(in);
    if (in != 0) {
      Waiting second = take(in);
      sort(second, nearest);
      if (in != 0) {
        Waiting third = take(in);
        sort(third, second);
        sort(second, nearest);
        const std::size_t base = waiting;
        waiting_[waiting++] = third;
        while (in != 0) {
          Waiting other = take(in);
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

  /// W spheres of a leaf.
  struct LeafPart {
    Vec3<Real> center;
    Real radius;
    std::uint32_t first;  ///< slot
    RealMask own;         ///< the one that the ray leaves
  };
  BOULE_INLINE LeafPart get_part(std::uint32_t index, std::size_t part) const {
    const SphereBlock& leaf = leaves_[index];
    const std::size_t at = part * width;
    const auto first = static_cast<std::uint32_t>(spheres_.scanned + index * bvh_leaf_size + at);
    RealMask own = uniform(false);
    if (exact_.source != no_primitive)
      own = load_integers(spheres_.id + first) == Bits(exact_.source);
    return {{load(leaf.center_x + at), load(leaf.center_y + at), load(leaf.center_z + at)},
            load(leaf.radius + at),
            first,
            own};
  }
  BOULE_INLINE RealMask may_meet(const LeafPart& spheres) const {
    return RejectSpheres(spheres.center, spheres.radius)
        .may_meet(FlightRay::all(ray_.org), FlightRay::all(ray_.h), ray_.origin_error, ray_.reach);
  }
  /// Makes the spheres of a leaf that may be hit candidates, and ends the reach behind those that
  /// certainly are. Returns whether one certainly is before the end of the ray.
  BOULE_INLINE bool list_hits(std::uint32_t leaf) {
    bool sure = false;
    for (std::size_t part = 0; part < parts; ++part) {
      const LeafPart spheres = get_part(leaf, part);
      // The ray hits its own sphere again only if it leaves it on its inside; only double can find
      // the hit.
      if (exact_.inside && any(spheres.own)) {
        candidates_.add(Real(-static_cast<float>(no_hit)), count_from(spheres.first),
                        bits(spheres.own));
      }
      if (!any(may_meet(spheres) & ~spheres.own)) continue;
      const FilterRays rays = ray_.filter();
      const NextRoots roots(find_approach(rays, spheres.center, spheres.radius), rays,
                            Real(ray_.reach), spheres.own);
      candidates_.add(roots.low, count_from(spheres.first), bits(roots.in));
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
  /// The roots of one ray and one sphere by the formulas of solve_robust(): the same bits.
  struct Chord {
    double enter, leave;
    bool met;
  };
  BOULE_INLINE Chord meet(std::uint32_t slot, std::int32_t id) const {
    const SlotSphere sphere = get_slot(spheres_, slot);
    const Vec3d center{double{sphere.x}, double{sphere.y}, double{sphere.z}};
    const auto line = meet_lines(exact_, center, double{sphere.radius});
    if (id != exact_.source) return {line.enter, line.leave, 0 <= line.discriminant};
    return {-no_hit, (line.b + line.b) * exact_.inverse_a, exact_.inside};
  }
  BOULE_INLINE void solve(std::uint32_t slot, Hit& hit) {
    const std::int32_t id = id_of(spheres_, slot);
    const Chord chord = meet(slot, id);
    if (!chord.met) return;
    const double t = holds(chord.enter) ? chord.enter : chord.leave;
    if (!holds(t)) return;
    if (!(t < hit.t || (t == hit.t && is_lower(id, hit.id)))) return;
    hit = {t, id, slot};
    const auto solved = static_cast<float>(t * length_);
    if (solved < ray_.reach) ray_.reach = solved;
  }
  template <class Add>
  BOULE_INLINE bool add_chord(std::uint32_t slot, const Add& add) const {
    const std::int32_t id = id_of(spheres_, slot);
    const Chord chord = meet(slot, id);
    const bool counts = chord.met && exact_.tmin < chord.leave && chord.enter <= exact_.tmax;
    return counts && add(chord.enter, chord.leave, id, slot);
  }
  [[nodiscard]] BOULE_INLINE bool holds(double t) const {
    return exact_.tmin < t && t <= exact_.tmax;
  }

  const SphereView& spheres_;
  const BvhNode* nodes_;
  const SphereBlock* leaves_;
  ExactRay exact_;
  double length_;
  bool judged_;
  FlightRay ray_;
  NodeRows rows_;
  FlightCandidates candidates_;
  Waiting waiting_[room];
};

}  // namespace boule::BOULE_KERNEL_ISA
