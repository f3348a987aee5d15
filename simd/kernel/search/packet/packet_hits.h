#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/leaf/best_hit.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/tuning.h"

/// Packets of a stream: loading them, and storing their results.
namespace boule::BOULE_KERNEL_ISA {

/// Loads a packet, and prefetches a later one into the cache.
BOULE_INLINE void load_ahead(const PaddedStream& stream, std::size_t first, RayLanes& rays) {
  const PacketRef from = stream.packet(first);
  prefetch_packet(stream.rays(), first + tuning::prefetch_distance);
  load_packet(*from.rays, from.first, rays);
}

/// Stores the results of a packet, in which `live` lanes are rays of the stream.
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

}  // namespace boule::BOULE_KERNEL_ISA
