#pragma once

#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/abi/isa.h"

namespace boule::BOULE_KERNEL_ISA {

/// Streams of rays against capsules, once all other primitives have been searched: rays with a
/// nearer hit, or with any, are done. Every solver decides as robust does. Answers: HitStream, or
/// std::uint8_t*. (capsules.cpp)
template <class Answers>
void trace_capsules(const CapsuleView& capsules, const RayStream& rays, const Query& query,
                    const Answers& answers);

}  // namespace boule::BOULE_KERNEL_ISA
