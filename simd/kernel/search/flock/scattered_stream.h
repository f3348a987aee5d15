#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/abi/isa.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/packet/packet_stream.h"
#include "simd/kernel/search/packet/parts.h"

/// Streams of rays without a promise of coherence, as sets, as packets or, for nearest hits, in
/// flight or sorted. From time to time some rays are traced each way, and the fastest way traces
/// the next ones. The way of a ray affects only the time. Answers: HitStream, or std::uint8_t*.
/// (scattered.cpp)
namespace boule::BOULE_KERNEL_ISA {

enum class Way : std::uint32_t { set, packet, flight, sorted };

/// Traces rays begin .. end - 1; `begin` is a multiple of W. `form`: automatic; or flight or set,
/// which run without trials. `known`: Query::experience.
template <class Answers>
void trace_scattered(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                     std::size_t end, Form form, Experience* known, const Answers& answers);
/// The same through parts: as packets.
template <class Answers>
BOULE_INLINE void trace_scattered(const PartsGeometry& geometry, const PaddedStream& stream,
                                  std::size_t begin, std::size_t end, Form form,
                                  Experience* /*known*/, const Answers& answers) {
  trace_groups(geometry, stream, begin, end, Solver::robust, form, answers);
}

}  // namespace boule::BOULE_KERNEL_ISA
