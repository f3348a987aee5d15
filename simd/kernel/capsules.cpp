// Packets and single rays against capsules, after all other primitives.
#include "simd/kernel/search/packet/capsule_search.h"
#include "simd/kernel/search/packet/capsule_stream.h"
#include "simd/kernel/search/packet/packet_hits.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

/// The nearest hit per lane, from the one among the other primitives on.
class ClosestCapsule : public ClosestHit {
 public:
  BOULE_INLINE ClosestCapsule(const RayLanes& rays, const Wide& t_so_far, const Bits& id_so_far,
                              const Bits& slot_so_far)
      : ClosestHit(rays) {
    t = t_so_far;
    id = id_so_far;
    slot = slot_so_far;
    const Real known = distance(t, rays);
    reach = select(known < reach, known, reach);
  }
  BOULE_INLINE void meet(const RayLanes& rays, const CapsuleLanes& capsule, const Bits& in_slot,
                         unsigned /*out*/) {
    offer(solve_robust(rays, capsule), capsule.id, in_slot, rays);
  }
};

/// Whether each lane has a hit; one_ray: the same ray is in all of them.
template <bool one_ray>
class AnyCapsule : public AnyHit<one_ray> {
 public:
  using AnyHit<one_ray>::AnyHit;

  BOULE_INLINE void meet(const RayLanes& rays, const CapsuleLanes& capsule, const Bits& in_slot,
                         unsigned /*out*/) {
    this->offer(solve_robust(rays, capsule), capsule.id, in_slot, rays);
  }
};

/// Calls packet(rays, first, live) for packets with a lane in wanted(first, live), which gives the
/// lanes that need a search as bits, and single(rays, index) for rays that go alone.
template <class Wanted, class Packet, class Single>
BOULE_INLINE void for_each_packet(const RayStream& rays, Form form, const Wanted& wanted,
                                  const Packet& packet, const Single& single) {
  const PaddedStream stream(rays);
  RayLanes lanes;
  for (std::size_t first = 0; first < rays.size; first += width) {
    const std::size_t live = stream.live(first);
    unsigned left = wanted(first, live);
    if (left == 0) continue;
    if (form == Form::single || count_bits(left) <= static_cast<int>(tuning::most_single_rays)) {
      for (; left != 0; left &= left - 1) {
        const std::size_t index = first + static_cast<std::size_t>(__builtin_ctz(left));
        load_single(rays, index, lanes);
        single(lanes, index);
      }
    } else {
      load_ahead(stream, first, lanes);
      packet(lanes, first, live);
    }
  }
}

/// The nearest over the lanes, which hold one ray; at equal t, the lower id.
BOULE_INLINE void store_nearest(const ClosestHit& best, const HitStream& hits, std::size_t index) {
  alignas(64) double t[width];
  alignas(64) std::int32_t id[width];
  alignas(64) std::uint32_t slot[width];
  store(t, best.t);
  store(id, best.id);
  store(slot, best.slot);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const bool tie = t[lane] == hits.t[index] && is_lower(id[lane], hits.id[index]);
    if (!(t[lane] < hits.t[index] || tie)) continue;
    hits.t[index] = t[lane];
    hits.id[index] = id[lane];
    hits.slot[index] = slot[lane];
  }
}

}  // namespace

void closest_capsules(const CapsuleView& capsules, const RayStream& rays, Form form,
                      const HitStream& hits) {
  for_each_packet(
      rays, form, [](std::size_t, std::size_t live) { return first_lanes(live); },
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        ClosestCapsule best(packet, load(hits.t + first), load_integers(hits.id + first),
                            load_integers(hits.slot + first));
        search_capsules<OneForAll>(packet, capsules, best);
        store_packet(best, hits, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        ClosestCapsule best(ray, Wide(hits.t[index]), Bits(hits.id[index]), Bits(hits.slot[index]));
        search_capsules<OnePerLane>(ray, capsules, best);
        store_nearest(best, hits, index);
      });
}

void any_capsules(const CapsuleView& capsules, const RayStream& rays, Form form,
                  std::uint8_t* occluded) {
  const auto open = [&](std::size_t first, std::size_t live) {
    unsigned lanes = 0;
    for (std::size_t lane = 0; lane < live; ++lane)
      lanes |= (occluded[first + lane] == 0 ? 1U : 0U) << lane;
    return lanes;
  };
  for_each_packet(
      rays, form, open,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        AnyCapsule<false> best(packet);
        best.hit = ~open(first, live) & all_lanes;
        search_capsules<OneForAll>(packet, capsules, best);
        store_packet(best, occluded, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        AnyCapsule<true> best(ray);
        search_capsules<OnePerLane>(ray, capsules, best);
        occluded[index] = best.hit != 0 ? 1 : 0;
      });
}

}  // namespace boule::BOULE_KERNEL_ISA
