#pragma once

#include <cstddef>

#include "simd/abi/geometry.h"
#include "simd/abi/isa.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/packet/parts.h"

/// Streams of rays as packets of W neighbours, and as single rays where those would not fill a
/// packet. Chosen for both solvers if Form says so, if there is no tree, and if a trial finds
/// packets fastest (scattered_stream.h). Coherent neighbours are faster; the hits are the same.
namespace boule::BOULE_KERNEL_ISA {

/// Finds the nearest hits of rays begin .. end - 1, or whether they hit anything. `begin` is a
/// multiple of W, unless all rays are traced alone. Returns the number of visited nodes and leaves.
/// Geometry: GeometryView, or PartsGeometry; Answers: HitStream, or std::uint8_t*. (packets.cpp)
template <class Geometry, class Answers>
std::size_t trace_groups(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                         std::size_t end, Solver solver, Form form, const Answers& answers);

/// The same for all rays of a stream, each alone: without the copies that fill packets up.
/// (packets.cpp)
template <class Geometry, class Answers>
void trace_alone(const Geometry& geometry, const RayStream& rays, Solver solver,
                 const Answers& answers);

/// KernelTable::closest_of_ray() and any_of_ray(), for a geometry of one part without capsules.
/// Answer: Hit, or bool.
/// (packets.cpp)
template <class Answer>
bool trace_ray(const GeometryView& geometry, const Ray& ray, Answer& answer);

}  // namespace boule::BOULE_KERNEL_ISA
