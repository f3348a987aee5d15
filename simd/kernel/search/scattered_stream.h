#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/flight_stream.h"
#include "simd/kernel/search/packet_stream.h"
#include "simd/kernel/tuning.h"

/// Streams of rays of which nothing is promised: they fly, or go as packets. Now and then some rays
/// are traced either way, and what did better traces the next ones. Which way a ray goes changes
/// nothing but the time.
namespace boule::BOULE_KERNEL_ISA {

/// Traces all rays. `form`: automatic, or flight, which has no trials.
template <class Answers>
BOULE_NOINLINE void trace_scattered(const GeometryView& geometry, const PaddedStream& stream,
                                    Form form, const Answers& answers) {
  const std::size_t size = stream.rays().size;
  Flights<Answers> flights(geometry, stream, answers);
  if (form == Form::flight) {
    flights.run(0, size);
    return;
  }
  // As if a trial of half as many rays had preferred flights: one that agrees doubles the number.
  std::size_t begin = 0, rays_that_way = tuning::rays_after_trial / 2;
  bool was_packets = false;
  float visits = 0, steps = 0;
  const auto next = [&](std::size_t rays) { return size - begin < rays ? size : begin + rays; };
  while (begin < size) {
    const std::size_t packets_end = next(tuning::rays_on_trial);
    visits = visits * tuning::share_of_earlier_trials +
             static_cast<float>(trace_groups<Solver::robust>(geometry, stream, begin, packets_end,
                                                             Form::automatic, answers));
    begin = packets_end;
    if (begin == size) return;
    const std::size_t flights_end = next(tuning::rays_on_trial);
    steps = steps * tuning::share_of_earlier_trials +
            static_cast<float>(flights.run(begin, flights_end));
    begin = flights_end;
    const bool packets = visits * tuning::steps_a_visit<Flights<Answers>::any_hit> < steps;
    rays_that_way = packets != was_packets                     ? tuning::rays_after_trial
                    : rays_that_way < tuning::most_after_trial ? 2 * rays_that_way
                                                               : tuning::most_after_trial;
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
