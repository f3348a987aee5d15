#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/flight_stream.h"

/// Streams of rays of which nothing is known: in flight, or as packets where they turn out to have
/// much in common.
namespace boule::BOULE_KERNEL_ISA {

/// Rays that are traced either way now and then, to see which is the better one, and those that
/// then go that way: at first, and at most, for they double while trials, which cost time, agree.
/// What earlier trials saw counts half as much: 32 rays may mislead.
inline constexpr std::size_t rays_on_trial = 32;
inline constexpr std::size_t rays_after_trial = 1984, most_after_trial = 8 * rays_after_trial;
/// A packet's visit takes as long as so many steps of rays in flight. Measured where the choice is
/// close, scenes of 1,000 to 600,000 spheres, 8 and 16 lanes: nearest hits of bounced rays 3.3 to
/// 3.8, and 5.3 to 6.6; any hit 3.1 to 4.1, and 5 to 6.4, the more the larger the scene.
template <bool any>
inline constexpr float steps_a_visit = any ? (width < 16 ? 3.7F : 5.9F)
                                           : (width < 16 ? 3.6F : 5.7F);

template <class Answers>
BOULE_NOINLINE void trace_scattered(const GeometryView& geometry, const PaddedStream& stream,
                                    Form form, const Answers& answers) {
  const std::size_t size = stream.rays().size;
  Flights<Answers> flights(geometry, stream, answers);
  if (form == Form::flight) {
    flights.run(0, size);
    return;
  }
  std::size_t begin = 0, rays_that_way = rays_after_trial / 2;
  bool was_packets = false;
  float visits = 0, steps = 0;
  const auto next = [&](std::size_t rays) { return size - begin < rays ? size : begin + rays; };
  while (begin < size) {
    const std::size_t packets_end = next(rays_on_trial);
    visits = visits * 0.5F + static_cast<float>(trace_groups<Solver::robust>(
                                 geometry, stream, begin, packets_end, Form::automatic, answers));
    begin = packets_end;
    if (begin == size) return;
    const std::size_t flights_end = next(rays_on_trial);
    steps = steps * 0.5F + static_cast<float>(flights.run(begin, flights_end));
    begin = flights_end;
    const bool packets = visits * steps_a_visit<Flights<Answers>::seeks_any> < steps;
    rays_that_way = packets != was_packets             ? rays_after_trial
                    : rays_that_way < most_after_trial ? 2 * rays_that_way
                                                       : most_after_trial;
    was_packets = packets;
    const std::size_t end = next(rays_that_way);
    if (packets) {
      trace_groups<Solver::robust>(geometry, stream, begin, end, Form::automatic, answers);
    } else {
      flights.run(begin, end);
    }
    begin = end;
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
