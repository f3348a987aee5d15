#pragma once

#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/abi/stream.h"
#include "simd/kernel/search/leaf/padded_stream.h"

/// Streams of coherent rays, as bundles. (bundles.cpp)
namespace boule::BOULE_KERNEL_ISA {

/// Finds the nearest hits. `coherence`: common_origin or common_direction. Geometry, here and
/// below: GeometryView, or PartsGeometry.
template <class Geometry>
void closest_hit_bundled(const Geometry& geometry, const PaddedStream& stream, Coherence coherence,
                         const HitStream& hits);

/// Finds whether rays hit anything. `coherence`: any but none. `known`: Query::experience.
template <class Geometry>
void any_hit_bundled(const Geometry& geometry, const PaddedStream& stream, Coherence coherence,
                     Experience* known, std::uint8_t* occluded);

}  // namespace boule::BOULE_KERNEL_ISA
