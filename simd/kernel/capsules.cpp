// Packets and single rays against capsules, after all other primitives.
#include "simd/kernel/search/packet/capsule_search.h"
#include "simd/kernel/search/packet/capsule_stream.h"
#include "simd/kernel/search/packet/capsules_near.h"
#include "simd/kernel/search/packet/packet_hits.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

/// Pairs of a ray and a capsule that wait for the double solver, which takes W of them at a time.
/// Answers: HitStream for nearest hits, std::uint8_t* for any.
template <class Answers>
class CapsuleQueue {
 public:
  CapsuleQueue(const RayStream& rays, const CapsuleView& capsules, const Answers& answers)
      : rays_(rays), capsules_(capsules), answers_(answers) {}

  BOULE_INLINE void add(std::size_t ray, std::uint32_t slot) {
    gathered_.set(size_, rays_, ray);
    ray_[size_] = ray;
    slot_[size_] = slot;
    if (++size_ == width) finish();
  }
  /// Solves the pairs that wait.
  BOULE_NOINLINE void finish() {
    if (size_ == 0) return;
    for (std::size_t k = size_; k < width; ++k) {
      gathered_.set(k, rays_, ray_[0]);
      slot_[k] = slot_[0];
    }
    ExactRays rays;
    load_exact(gathered_.view(width), 0, rays);
    const CapsuleLanes capsules = gather_capsules(capsules_, slot_);
    const Roots roots = solve_robust(rays, capsules);
    alignas(64) double t[width];
    alignas(64) std::int32_t id[width];
    store(t, roots.t);
    store(id, capsules.id);
    for (unsigned hit = bits(roots.hit) & first_lanes(size_); hit != 0; hit &= hit - 1) {
      const int k = __builtin_ctz(hit);
      answer(answers_, ray_[k], {t[k], id[k], slot_[k]});
    }
    size_ = 0;
  }

 private:
  static void answer(const HitStream& hits, std::size_t ray, const Hit& hit) {
    const bool tie = hit.t == hits.t[ray] && is_lower(hit.id, hits.id[ray]);
    if (!(hit.t < hits.t[ray] || tie)) return;
    hits.t[ray] = hit.t;
    hits.id[ray] = hit.id;
    hits.slot[ray] = hit.slot;
  }
  static void answer(std::uint8_t* occluded, std::size_t ray, const Hit& /*hit*/) {
    occluded[ray] = 1;
  }

  const RayStream& rays_;
  const CapsuleView& capsules_;
  const Answers& answers_;
  GatheredRays<width> gathered_;
  std::size_t ray_[width];
  std::uint32_t slot_[width];
  std::size_t size_ = 0;
};

/// The capsules that may be the nearest hit of a lane, from the hit among the other primitives on.
template <bool one_ray>
class NearestCapsules {
 public:
  /// `first`: the index of the first lane's ray. `t`: of the hits so far.
  BOULE_INLINE NearestCapsules(const RayLanes& rays, std::size_t first, const Wide& t,
                               CapsuleQueue<HitStream>& queue)
      : first_(first), queue_(queue), reach_(ClosestHit::distance(rays.exact.tmax, rays)) {
    const Real known = ClosestHit::distance(t, rays);
    reach_ = select(known < reach_, known, reach_);
  }

  static constexpr bool ordered = true;
  static constexpr bool done() { return false; }
  static constexpr unsigned open(unsigned lanes) { return lanes; }
  [[nodiscard]] BOULE_INLINE Real limit() const { return reach_; }
  [[nodiscard]] BOULE_INLINE bool wants(const Real& low, unsigned out) const {
    return (bits(reach_ < low) | out) != all_lanes;
  }
  BOULE_INLINE void consider(const RayLanes& rays, const CapsuleLanes& capsule,
                             const CapsuleBounds& bounds, const Bits& slot, unsigned out) {
    if (size_ + width > room) make_room();
    const RealMask counts = bounds.certain & (rays.filter.live_from < bounds.low) &
                            ~(rays.exact.source == capsule.id) & (bounds.high < reach_);
    unsigned in = ~(bits(reach_ < bounds.low) | out) & all_lanes;
    // A lane whose ray is out because of its limit is left as it is: `high` lies beyond that.
    reach_ = select(counts, bounds.high, reach_);
    if (one_ray) reach_ = Real(least_lane(reach_));
    alignas(64) float low[width];
    alignas(64) std::uint32_t slots[width];
    store(low, bounds.low);
    store(slots, slot);
    for (; in != 0; in &= in - 1) {
      const int lane = __builtin_ctz(in);
      low_[size_] = low[lane];
      slot_[size_] = slots[lane];
      lane_[size_] = static_cast<std::uint8_t>(one_ray ? 0 : lane);
      ++size_;
    }
  }
  /// Hands the candidates that may still be the nearest to the double solver.
  BOULE_INLINE void finish(unsigned lanes) {
    keep_wanted();
    for (std::size_t k = 0; k < size_; ++k)
      if ((lanes >> lane_[k] & 1U) != 0) queue_.add(first_ + lane_[k], slot_[k]);
    size_ = 0;
  }

 private:
  /// Drops the candidates beyond the reach of their lanes.
  BOULE_INLINE void keep_wanted() {
    alignas(64) float reach[width];
    store(reach, reach_);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      const bool beyond = reach[lane_[k]] < low_[k];
      low_[kept] = low_[k];
      slot_[kept] = slot_[k];
      lane_[kept] = lane_[k];
      kept += beyond ? 0 : 1;
    }
    size_ = kept;
  }
  BOULE_NOINLINE void make_room() {
    keep_wanted();
    if (size_ + width > room) finish(all_lanes);
  }

  static constexpr std::size_t room = 8 * width;

  std::size_t first_;
  CapsuleQueue<HitStream>& queue_;
  Real reach_;
  float low_[room];
  std::uint32_t slot_[room];
  std::uint8_t lane_[room];
  std::size_t size_ = 0;
};

/// Whether a lane hits any capsule; one_ray: the same ray is in all of them.
template <bool one_ray>
class AnyCapsule : public AnyHit<one_ray> {
 public:
  using AnyHit<one_ray>::hit;
  using AnyHit<one_ray>::far;

  BOULE_INLINE AnyCapsule(const RayLanes& rays, std::size_t first, unsigned occluded,
                          CapsuleQueue<std::uint8_t*>& queue)
      : AnyHit<one_ray>(rays), first_(first), queue_(queue) {
    hit = occluded;
  }
  BOULE_INLINE void consider(const RayLanes& rays, const CapsuleLanes& capsule,
                             const CapsuleBounds& bounds, const Bits& slot, unsigned out) {
    const RealMask found = bounds.certain & (rays.filter.live_from < bounds.low) &
                           (bounds.high <= rays.filter.live_to) &
                           ~(rays.exact.source == capsule.id);
    unsigned doubt = ~(bits(far < bounds.low) | out | bits(found)) & all_lanes;
    hit |= bits(found) & ~out;
    if (one_ray ? hit != 0 : (doubt & ~hit) == 0) return;
    alignas(64) std::uint32_t slots[width];
    store(slots, slot);
    for (doubt &= one_ray ? all_lanes : ~hit; doubt != 0; doubt &= doubt - 1) {
      const int lane = __builtin_ctz(doubt);
      queue_.add(one_ray ? first_ : first_ + static_cast<std::size_t>(lane), slots[lane]);
    }
  }

 private:
  std::size_t first_;
  CapsuleQueue<std::uint8_t*>& queue_;
};

/// Calls packet(rays, first, live, near) for packets with a lane in wanted(first, live), which
/// gives the lanes that need a search as bits, and single(rays, index) for rays that go alone.
/// `near`: as CapsulesNear finds them. Groups of rays without any are passed over.
template <class Wanted, class Packet, class Single>
BOULE_INLINE void for_each_packet(const CapsulesNear& capsules, const RayStream& rays,
                                  const Query& query, const Wanted& wanted, const Packet& packet,
                                  const Single& single) {
  const Form form = query.form;
  const PaddedStream stream(rays);
  RayLanes lanes;
  const CapsuleWedges wedges(capsules.view(), rays, query.coherence);
  NearCapsules near;
  std::size_t known_to = 0;  // of these rays `near` is known
  for (std::size_t first = 0; first < rays.size; first += width) {
    const std::size_t live = stream.live(first);
    unsigned left = wanted(first, live);
    if (left == 0) continue;
    if (wedges.known()) {
      near = {};
      near.listed = true;
      left = wedges.find(stream, first, left, near);
      near.any = left != 0;
    } else if (first >= known_to) {
      const std::size_t end = (first / tuning::capsule_group + 1) * tuning::capsule_group;
      known_to = end < rays.size ? end : rays.size;
      near = capsules.find(stream, query.coherence, first, known_to);
    }
    if (!near.any) continue;
    const bool few_rays = count_bits(left) <= static_cast<int>(tuning::most_single_rays);
    if (form == Form::single || (few_rays && !near.listed)) {
      for (; left != 0; left &= left - 1) {
        const std::size_t index = first + static_cast<std::size_t>(__builtin_ctz(left));
        load_single(rays, index, lanes);
        single(lanes, index);
      }
    } else {
      load_ahead(stream, first, lanes);
      packet(lanes, first, live, near);
    }
  }
}

/// Searches the capsules for a packet.
template <class Best>
BOULE_INLINE void search_near(const RayLanes& rays, const CapsuleView& capsules,
                              const NearCapsules& near, Best& best) {
  if (!near.listed) {
    search_capsules<OneForAll>(rays, capsules, best);
    return;
  }
  for (int i = 0; i < near.size && !best.done(); ++i)
    meet_one(rays, capsules, near.slot[i], 0, best);
}

void trace_all(const CapsuleView& capsules, const RayStream& rays, const Query& query,
               const HitStream& hits) {
  CapsuleQueue<HitStream> queue(rays, capsules, hits);
  const CapsulesNear known(capsules);
  for_each_packet(
      known, rays, query, [](std::size_t, std::size_t live) { return first_lanes(live); },
      [&](const RayLanes& packet, std::size_t first, std::size_t live, const NearCapsules& near) {
        NearestCapsules<false> nearest(packet, first, load(hits.t + first), queue);
        search_near(packet, capsules, near, nearest);
        nearest.finish(first_lanes(live));
      },
      [&](const RayLanes& ray, std::size_t index) {
        NearestCapsules<true> nearest(ray, index, Wide(hits.t[index]), queue);
        search_capsules<OnePerLane>(ray, capsules, nearest);
        nearest.finish(all_lanes);
      });
  queue.finish();
}

void trace_all(const CapsuleView& capsules, const RayStream& rays, const Query& query,
               std::uint8_t* occluded) {
  const auto open = [&](std::size_t first, std::size_t live) {
    return ~bits(load_set(occluded + first)) & first_lanes(live);
  };
  CapsuleQueue<std::uint8_t*> queue(rays, capsules, occluded);
  const CapsulesNear known(capsules);
  for_each_packet(
      known, rays, query, open,
      [&](const RayLanes& packet, std::size_t first, std::size_t live, const NearCapsules& near) {
        AnyCapsule<false> any(packet, first, ~open(first, live) & all_lanes, queue);
        search_near(packet, capsules, near, any);
        for (unsigned hit = any.hit & first_lanes(live); hit != 0; hit &= hit - 1)
          occluded[first + static_cast<std::size_t>(__builtin_ctz(hit))] = 1;
      },
      [&](const RayLanes& ray, std::size_t index) {
        AnyCapsule<true> any(ray, index, 0, queue);
        search_capsules<OnePerLane>(ray, capsules, any);
        if (any.hit != 0) occluded[index] = 1;
      });
  queue.finish();
}

}  // namespace

template <class Answers>
void trace_capsules(const CapsuleView& capsules, const RayStream& rays, const Query& query,
                    const Answers& answers) {
  trace_all(capsules, rays, query, answers);
}

template void trace_capsules(const CapsuleView&, const RayStream&, const Query&, const HitStream&);
template void trace_capsules(const CapsuleView&, const RayStream&, const Query&,
                             std::uint8_t* const&);

}  // namespace boule::BOULE_KERNEL_ISA
