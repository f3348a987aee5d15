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

/// What trials have found out: whether packets or flights take less time, and for how many rays
/// that is believed.
template <bool any>
class Choice {
 public:
  /// Takes a trial of packets, which visited so many nodes and leaves.
  void add_packets(std::size_t visits) {
    packets_ = packets_ * tuning::share_of_earlier_trials +
               static_cast<float>(visits) * tuning::steps_a_visit<any> +
               static_cast<float>(tuning::rays_on_trial) * tuning::steps_a_ray<any>;
  }
  /// Takes a trial of as many flights, and chooses.
  void add_flights(std::size_t steps) {
    flights_ = flights_ * tuning::share_of_earlier_trials + static_cast<float>(steps);
    const bool others = is_packets_ ? flights_ * tuning::gain_to_change<any> < packets_
                                    : packets_ * tuning::gain_to_change<any> < flights_;
    const bool packets = is_packets_ != others, agrees = !others;
    const auto [less, more] = packets ? Pair{packets_, flights_} : Pair{flights_, packets_};
    std::size_t rays = agrees ? 2 * rays_that_way_ : tuning::rays_after_trial;
    if (tuning::clearly_more * less < more) rays = tuning::most_after_trial;
    rays_that_way_ = rays < tuning::most_after_trial ? rays : tuning::most_after_trial;
    is_packets_ = packets;
  }
  [[nodiscard]] bool is_packets() const { return is_packets_; }
  /// How many rays go that way before the next trial.
  [[nodiscard]] std::size_t rays_that_way() const { return rays_that_way_; }

 private:
  struct Pair {
    float less, more;
  };
  float packets_ = 0, flights_ = 0;  ///< in steps of flights
  // As if a trial had preferred flights for half as many rays: one that agrees doubles the number.
  bool is_packets_ = false;
  std::size_t rays_that_way_ = tuning::rays_after_trial / 2;
};

/// Traces rays begin .. end - 1; `begin` is a multiple of W. `form`: automatic, or flight, which
/// has no trials.
template <class Answers>
BOULE_NOINLINE void trace_scattered(const GeometryView& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, Form form,
                                    const Answers& answers) {
  Flights<Answers> flights(geometry, stream, answers);
  if (form == Form::flight) {
    flights.run(begin, end);
    return;
  }
  Choice<Flights<Answers>::any_hit> choice;
  const auto next = [&](std::size_t rays) { return end - begin < rays ? end : begin + rays; };
  while (begin < end) {
    const std::size_t packets_end = next(tuning::rays_on_trial);
    choice.add_packets(trace_groups<Solver::robust>(geometry, stream, begin, packets_end,
                                                    Form::automatic, answers));
    begin = packets_end;
    if (begin == end) return;
    const std::size_t flights_end = next(tuning::rays_on_trial);
    choice.add_flights(flights.run(begin, flights_end));
    begin = flights_end;
    const std::size_t chosen_end = next(choice.rays_that_way());
    if (choice.is_packets()) {
      trace_groups<Solver::robust>(geometry, stream, begin, chosen_end, Form::automatic, answers);
    } else {
      flights.run(begin, chosen_end);
    }
    begin = chosen_end;
  }
}
/// The same through parts: as packets.
template <class Answers>
BOULE_INLINE void trace_scattered(const PartsGeometry& geometry, const PaddedStream& stream,
                                  std::size_t begin, std::size_t end, Form form,
                                  const Answers& answers) {
  trace_groups<Solver::robust>(geometry, stream, begin, end, form, answers);
}

}  // namespace boule::BOULE_KERNEL_ISA
