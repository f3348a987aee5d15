#pragma once

#include <cstddef>

#include "simd/abi/capsules.h"
#include "simd/abi/stream.h"

namespace boule::BOULE_KERNEL_ISA {

/// KernelTable::find_chords(): each ray is traced alone, which suits any rays. Geometry:
/// GeometryView, or PartsGeometry. (chords.cpp)
template <class Geometry>
std::size_t list_chords(const Geometry& geometry, const CapsuleView& capsules,
                        const RayStream& rays, std::size_t first, const ChordStream& chords,
                        std::size_t* ends);

}  // namespace boule::BOULE_KERNEL_ISA
