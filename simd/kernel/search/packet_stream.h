#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/padded_stream.h"
#include "simd/kernel/search/short_search.h"
#include "simd/kernel/search/traverse.h"
#include "simd/kernel/tuning.h"

/// Streams of rays as packets of W neighbours, and single rays where those would not fill a packet.
/// Chosen for both solvers where Form says so, where there is no tree, and where a trial finds
/// packets fastest (scattered_stream.h). Neighbours should have much in common, but
/// need not: only the time depends on it.
namespace boule::BOULE_KERNEL_ISA {

/// Whether the next ray goes alone. `remaining`: rays of the stream from it on.
BOULE_INLINE bool goes_single(Form form, std::size_t remaining) {
  if (form == Form::automatic) return remaining <= tuning::most_single_rays;
  return form == Form::single;
}

/// Loads a packet, and fetches one of the next into the cache.
BOULE_INLINE void load_ahead(const PaddedStream& stream, std::size_t first, RayLanes& rays) {
  const PacketRef from = stream.packet(first);
  prefetch_packet(stream.rays(), first + tuning::prefetch_distance);
  load_packet(*from.rays, from.first, rays);
}

/// Calls packet(rays, first, live) for packets, `live` of whose lanes are rays of the stream, and
/// single(rays, index) for single rays, so that rays begin .. end - 1 are covered once. `begin` is
/// a multiple of W.
template <class Packet, class Single>
BOULE_INLINE void for_each_group(const PaddedStream& stream, std::size_t begin, std::size_t end,
                                 Form form, const Packet& packet, const Single& single) {
  RayLanes rays;
  std::size_t first = begin;
  while (first < end) {
    if (goes_single(form, end - first)) {
      load_single(stream.rays(), first, rays);
      single(rays, first);
      ++first;
    } else {
      load_ahead(stream, first, rays);
      packet(rays, first, stream.live(first));
      first += width;
    }
  }
}

BOULE_INLINE void store_packet(const ClosestHit& best, const HitStream& hits, std::size_t first,
                               std::size_t live) {
  if (live == width) {
    store(hits.t + first, best.t);
    store(hits.id + first, best.id);
    store(hits.slot + first, best.slot);
    return;
  }
  alignas(64) double t[width];
  alignas(64) std::int32_t id[width];
  alignas(64) std::uint32_t slot[width];
  store(t, best.t);
  store(id, best.id);
  store(slot, best.slot);
  for (std::size_t lane = 0; lane < live; ++lane) {
    hits.t[first + lane] = t[lane];
    hits.id[first + lane] = id[lane];
    hits.slot[first + lane] = slot[lane];
  }
}

BOULE_INLINE void store_packet(const AnyHit<false>& best, std::uint8_t* occluded, std::size_t first,
                               std::size_t live) {
  for (std::size_t lane = 0; lane < live; ++lane)
    occluded[first + lane] = static_cast<std::uint8_t>((best.hit >> lane) & 1U);
}

/// One ray's hit is the nearest over the lanes; equal t: the lower id.
BOULE_INLINE void store_single(const ClosestHit& best, const HitStream& hits, std::size_t index) {
  alignas(64) double t[width];
  alignas(64) std::int32_t id[width];
  alignas(64) std::uint32_t slot[width];
  store(t, best.t);
  store(id, best.id);
  store(slot, best.slot);
  std::size_t nearest = 0;
  for (std::size_t lane = 1; lane < width; ++lane) {
    const bool tie = t[lane] == t[nearest] && is_lower(id[lane], id[nearest]);
    if (t[lane] < t[nearest] || tie) nearest = lane;
  }
  hits.t[index] = t[nearest];
  hits.id[index] = id[nearest];
  hits.slot[index] = slot[nearest];
}

/// Finds the nearest hits of rays begin .. end - 1.
template <Solver solver, class Geometry>
BOULE_NOINLINE void trace_groups(const Geometry& geometry, const PaddedStream& stream,
                                 std::size_t begin, std::size_t end, Form form,
                                 const HitStream& hits) {
  for_each_group(
      stream, begin, end, form,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        ClosestHit best(packet);
        search<solver, OneForAll>(packet, geometry, best);
        store_packet(best, hits, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        ClosestHit best(ray);
        search<solver, OnePerLane>(ray, geometry, best);
        store_single(best, hits, index);
      });
}

/// Traces pairs of packets while there are any. Returns how many nodes and leaves were visited, and
/// moves `begin` on.
template <Solver solver>
BOULE_INLINE std::size_t trace_pairs(const GeometryView& geometry, const PaddedStream& stream,
                                     std::size_t& begin, std::size_t end, std::uint8_t* occluded) {
  std::size_t visits = 0;
  TwoPackets packets;
  for (; begin + 2 * width <= end; begin += 2 * width) {
    load_ahead(stream, begin, packets.rays[0]);
    load_ahead(stream, begin + width, packets.rays[1]);
    AnyHit<false> best[2] = {AnyHit<false>(packets.rays[0]), AnyHit<false>(packets.rays[1])};
    visits += search_two<solver>(packets, geometry, best);
    for (std::size_t p = 0; p < 2; ++p) store_packet(best[p], occluded, begin + p * width, width);
  }
  return visits;
}
template <Solver solver>
std::size_t trace_pairs(const PartsGeometry&, const PaddedStream&, std::size_t&, std::size_t,
                        std::uint8_t*) {
  return 0;
}

/// Finds whether they hit anything. Returns how many nodes and leaves were visited.
template <Solver solver, class Geometry>
BOULE_NOINLINE std::size_t trace_groups(const Geometry& geometry, const PaddedStream& stream,
                                        std::size_t begin, std::size_t end, Form form,
                                        std::uint8_t* occluded) {
  std::size_t visits = 0;
  if (form != Form::single) visits += trace_pairs<solver>(geometry, stream, begin, end, occluded);
  for_each_group(
      stream, begin, end, form,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        AnyHit<false> best(packet);
        visits += search<solver, OneForAll>(packet, geometry, best);
        store_packet(best, occluded, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        AnyHit<true> best(ray);
        visits += search<solver, OnePerLane>(ray, geometry, best);
        occluded[index] = best.hit != 0 ? 1 : 0;
      });
  return visits;
}

}  // namespace boule::BOULE_KERNEL_ISA
