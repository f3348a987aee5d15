#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/kernel/search/bundle/bundle_grid.h"
#include "simd/kernel/search/bundle/bundle_lines.h"
#include "simd/kernel/tuning.h"

/// Occlusion of the rays of a bundle. Float decides nearly always. The double solver decides where
/// a ray passes a sphere's rim, or ends near the sphere, too closely for float. Where few rays are
/// near a leaf's spheres, each ray is tested alone, W spheres at a time.
namespace boule::BOULE_KERNEL_ISA {

/// The origins and starts of a bundle's packets, for any source.
class BundleStarts {
 public:
  template <class Source>
  BOULE_INLINE BundleStarts(const Source& source, int packets)
      : source_(&source), packet_([](const void* from, int ray, unsigned wanted) {
          return static_cast<const Source*>(from)->packet(ray, wanted);
        }) {
    for (int p = 0; p < packets; ++p) starts_[p] = source.start(p * width);
  }
  [[nodiscard]] BOULE_INLINE const PacketStart& of(int packet) const { return starts_[packet]; }
  /// The rays of a packet that the bits of `wanted` name; valid until the next call.
  [[nodiscard]] BOULE_INLINE PacketRef packet(int packet, unsigned wanted) const {
    return packet_(source_, packet * width, wanted);
  }

 private:
  const void* source_;
  PacketRef (*packet_)(const void* source, int ray, unsigned wanted);
  PacketStart starts_[bundle_packets];
};

template <Common common, class Spheres>
class BundleAny {
 public:
  static constexpr Sought sought = Sought::any;

  BundleAny(const BundleStarts& starts, const Spheres& spheres, const BundleRays& rays)
      : starts_(starts), spheres_(spheres), rays_(rays) {
    for (int p = 0; p < rays.packets; ++p) start(p);
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// For each group the largest v at which its open rays still search; -inf without open rays. A
  /// ray is open until it has a hit.
  [[nodiscard]] const float* limits() const { return limits_; }
  [[nodiscard]] float limit() const { return limit_; }
  [[nodiscard]] bool done() const { return limit_ == -static_cast<float>(no_hit); }
  /// Whether float was undecided too often. That happens where the rays begin among spheres that
  /// are tiny for their distance from the light.
  [[nodiscard]] bool too_close() const { return unclear_ > tuning::most_unclear * rays_.packets; }

  /// Tests a simple sphere against the rays of a group. Returns whether their hits may have
  /// changed; if so, call update() before limit().
  BOULE_INLINE bool meet(int group, const DiscLanes& disc, std::uint32_t slot) {
    const BundleRays& rays = rays_;
    const PacketRange packets = packets_of(rays, group);
    bool changed = false;
    int p = packets.begin;
    for (; p + 2 <= packets.end; p += 2) {
      const Real q0 = disc_square<common>(rays, p * width, disc);
      const Real q1 = disc_square<common>(rays, (p + 1) * width, disc);
      if (!any((Real(0.0F) <= q0) | (Real(0.0F) <= q1))) continue;
      changed |= consider(p, disc, q0, slot);
      changed |= consider(p + 1, disc, q1, slot);
    }
    if (p < packets.end)
      changed |= consider(p, disc, disc_square<common>(rays, p * width, disc), slot);
    if (changed) update(group);
    return changed;
  }

  /// Tests discs against the rays near them, one by one. Returns false, without effect, if those
  /// rays are many.
  BOULE_INLINE bool meet_few(const Discs& discs, const BlockSpheres& spheres) {
    const unsigned groups = groups_near(rays_.groups, limits_, discs.all, discs.all_near);
    if (count_bits(groups) > few_.groups) return false;
    int rays[tuning::few_if_sparse.rays + group_size], count = 0;
    for (unsigned left = groups; left != 0; left &= left - 1) {
      const int group = std::countr_zero(left), first_ray = packets_of(rays_, group).begin * width;
      for (unsigned in = open_amid(group, discs); in != 0; in &= in - 1)
        rays[count++] = first_ray + std::countr_zero(in);
      if (count > few_.rays) return false;
    }
    // A first pass drops the rays that miss all discs, without a branch for each.
    int near = 0;
    for (int i = 0; i < count; ++i) {
      rays[near] = rays[i];
      near += touches(rays[i], discs) ? 1 : 0;
    }
    bool changed = false;
    for (int i = 0; i < near; ++i) changed |= meet_ray(rays[i], discs, spheres);
    if (!changed) return true;
    for (unsigned left = groups; left != 0; left &= left - 1) update(std::countr_zero(left));
    update();
    return true;
  }

  /// Enters the open rays into the grid. For sparse bundles, where more rays count as few.
  void fill(RayGrid& grid) {
    grid.fill(rays_, hit_, end_high_);
    few_ = tuning::few_if_sparse;
  }

  /// Tests a sphere that is not simple against all rays.
  BOULE_NOINLINE void meet_awkward(std::uint32_t slot) {
    for (int p = 0; p < rays_.packets; ++p) {
      if (hit_[p] != all_lanes) resolve(p, slot, all_lanes & ~hit_[p]);
    }
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// Recomputes limit().
  BOULE_INLINE void update() { limit_ = greatest_of_groups(limits_); }

  /// Adds the planes, and finds the rays of each packet that have a hit, as bits.
  void finish(const PlaneView& planes, unsigned* hit) {
    for (int p = 0; p < rays_.packets; ++p) {
      if (planes.size != 0 && hit_[p] != all_lanes) meet_planes(p, planes);
      hit[p] = hit_[p];
    }
  }

 private:
  BOULE_INLINE void update(int group) {
    const PacketRange packets = packets_of(rays_, group);
    float most = -static_cast<float>(no_hit);
    for (int p = packets.begin; p < packets.end; ++p)
      most = hit_[p] != all_lanes && last_[p] > most ? last_[p] : most;
    limits_[group] = most;
  }

  /// Finds the range of v of each ray. Seen from a common end, rays run from v = (1 - tmax) scale,
  /// where they end, to scale, where they begin.
  BOULE_INLINE void start(int p) {
    const int ray = p * width;
    const Real zero(0.0F), shift(rays_.shift);
    const Real largest(std::numeric_limits<float>::max());
    const Real scale = load(rays_.scale + ray), tmax = load(starts_.of(p).tmax);
    const Real until = select(largest < tmax, largest, tmax);
    Real begin = zero, end_low = until * scale, end_high = end_low;
    if constexpr (common == Common::end) {
      begin = (Real(1.0F) - until) * scale + shift;
      end_low = scale - shift;
      end_high = scale + shift;
    }
    store(begin_ + ray, begin);
    store(end_low_ + ray, end_low);
    store(end_high_ + ray, end_high);
    const Real none(-static_cast<float>(no_hit));
    last_[p] = greatest_lane(select(none <= end_high, end_high, none));  // skips NaN
    hit_[p] = 0;
  }

  /// The ranges of v of rays.
  struct Lives {
    Real begin;              ///< upper bound of the begin
    Real end_low, end_high;  ///< bounds of the end
  };
  /// The decision of float, as bits: lanes that may hit, and lanes that certainly hit unless they
  /// leave that very sphere.
  struct Verdict {
    unsigned open, certain;
  };
  BOULE_INLINE static Verdict judge(const LineLanes& line, const Lives& lives,
                                    const DiscLanes& disc, const Real& q) {
    const Real from = first_root<common>(line, disc, q), to = from + disc.spread;
    RealMask open = from <= lives.end_high;  // false for Q < 0
    if constexpr (common == Common::direction) {
      const Real second = to + sqrt(q) + sqrt(q);  // upper bound of the second root
      open = open & (Real(0.0F) <= second);
    }
    const RealMask certain = open & (disc.sure <= q) & (lives.begin < from) & (to < lives.end_low);
    return {bits(open), bits(certain)};
  }

  /// Lets float decide about a sphere and W rays, and double where float is undecided. Returns
  /// whether anything may have changed.
  BOULE_INLINE bool consider(int p, const DiscLanes& disc, const Real& q, std::uint32_t slot) {
    const int ray = p * width;
    const Verdict verdict =
        judge(LineLanes::each<common>(rays_, ray),
              {load(begin_ + ray), load(end_low_ + ray), load(end_high_ + ray)}, disc, q);
    const unsigned open = verdict.open & ~hit_[p];
    if (open == 0) return false;
    const unsigned own = own_sphere(p, id_of(spheres_, slot));
    hit_[p] |= verdict.certain & open & ~own;
    const unsigned unclear = open & ~hit_[p] & ~leaves_outside(p, own);
    if (unclear != 0) {
      ++unclear_;
      resolve(p, slot, unclear);
    }
    return true;
  }

  /// The open rays of a group, as bits, that lie within the extent of the discs and end behind the
  /// first of them.
  BOULE_INLINE unsigned open_amid(int group, const Discs& discs) const {
    const Extent& e = discs.all;
    const Real near(discs.all_near);
    const Real a_low(e.a_low), a_high(e.a_high), b_low(e.b_low), b_high(e.b_high);
    const PacketRange packets = packets_of(rays_, group);
    unsigned result = 0;
    for (int p = packets.begin; p < packets.end; ++p) {
      const Real a = load(rays_.a + p * width), b = load(rays_.b + p * width);
      const unsigned in = bits((a_low <= a) & (a <= a_high) & (b_low <= b) & (b <= b_high) &
                               (near <= load(end_high_ + p * width)));
      result |= (in & ~hit_[p]) << ((p - packets.begin) * width);
    }
    return result;
  }

  /// Whether a ray may hit one of the simple spheres, as far as float can tell.
  BOULE_INLINE bool touches(int ray, const Discs& discs) const {
    const LineLanes line = LineLanes::same<common>(rays_, ray);
    const Real end(end_high_[ray]);
    unsigned in = 0;
    for (int at = 0; at < Discs::size; at += width) {
      if (discs.simple >> at == 0) break;
      const Real q = disc_square<common>(line, DiscLanes::each(discs, at));
      in |= bits((Real(0.0F) <= q) & (load(discs.near + at) <= end)) << at;
    }
    return (in & discs.simple) != 0;
  }

  /// Tests the simple spheres against one ray. Returns whether it hits one.
  BOULE_INLINE bool meet_ray(int ray, const Discs& discs, const BlockSpheres& spheres) {
    const LineLanes line = LineLanes::same<common>(rays_, ray);
    const Lives lives = {begin_[ray], end_low_[ray], end_high_[ray]};
    for (int at = 0; at < Discs::size; at += width) {
      if (discs.simple >> at == 0) break;
      const DiscLanes disc = DiscLanes::each(discs, at);
      const Real q = disc_square<common>(line, disc);
      if (!any(Real(0.0F) <= q)) continue;
      const Verdict verdict = judge(line, lives, disc, q);
      const unsigned open = verdict.open & discs.simple >> at;
      if (open != 0 && decide(ray, open, verdict.certain, spheres, at)) return true;
    }
    return false;
  }

  /// Decides whether a ray hits one of W spheres, from index `at` of their block on. `open`: the
  /// spheres that it may hit, as bits; `certain`: those that it hits unless it leaves them.
  BOULE_INLINE bool decide(int ray, unsigned open, unsigned certain, const BlockSpheres& spheres,
                           int at) {
    const int p = ray / width, lane = ray % width;
    const unsigned bit = 1U << lane;
    const PacketStart& start = starts_.of(p);
    for (unsigned left = open; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      const std::uint32_t slot = spheres.slot(at + k);
      const bool own = id_of(spheres_, slot) == start.source[lane];
      if (own && start.inside[lane] == 0) continue;  // never hit again
      if (own || ((certain >> k) & 1U) == 0) {
        ++unclear_;
        resolve(p, slot, bit);
      } else {
        hit_[p] |= bit;
      }
      if ((hit_[p] & bit) != 0) return true;
    }
    return false;
  }

  /// Lanes, as bits, whose rays leave the primitive `id`.
  BOULE_INLINE unsigned own_sphere(int p, std::int32_t id) const {
    return bits(load_integers(starts_.of(p).source) == Bits(id));
  }
  /// Among the lanes in `own`, whose rays leave a sphere, those that leave it on its outside: they
  /// never hit it again.
  BOULE_INLINE unsigned leaves_outside(int p, unsigned own) const {
    if (own == 0) return 0;
    return own & ~bits(load_set(starts_.of(p).inside));
  }

  /// Solves a sphere for the rays of packet p whose bits are set in `open`.
  BOULE_NOINLINE void resolve(int p, std::uint32_t slot, unsigned open) {
    const PacketRef packet = starts_.packet(p, open);
    ExactRays rays;
    load_exact(*packet.rays, packet.first, rays);
    hit_[p] |= open & bits(solve_robust(rays, broadcast_slot(spheres_, slot)).hit);
  }

  BOULE_NOINLINE void meet_planes(int p, const PlaneView& planes) {
    const unsigned open = all_lanes & ~hit_[p];
    const PacketRef packet = starts_.packet(p, open);
    ExactRays rays;
    load_exact(*packet.rays, packet.first, rays);
    for (std::size_t k = 0; k < planes.size; ++k)
      hit_[p] |= open & bits(solve_robust(rays, get_plane<OneForAll>(planes, k)).hit);
  }

  static constexpr int group_size = bundle_size / bundle_groups;
  static_assert(group_size <= 32);  // bits of an unsigned

  const BundleStarts& starts_;
  const Spheres& spheres_;
  const BundleRays& rays_;
  tuning::Few few_ = tuning::few_at_first;
  int unclear_ = 0;  ///< how often float was undecided
  float limit_ = 0;
  alignas(64) float limits_[bundle_groups];
  float last_[bundle_packets];            ///< the largest v in the range of a packet's rays
  unsigned hit_[bundle_packets];          ///< by packet, the rays that have a hit, as bits
  alignas(64) float begin_[bundle_size];  ///< as in Lives
  alignas(64) float end_low_[bundle_size], end_high_[bundle_size];  ///< as in Lives
};

}  // namespace boule::BOULE_KERNEL_ISA
