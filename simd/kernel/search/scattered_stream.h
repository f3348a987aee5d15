#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/abi/isa.h"
#include "simd/kernel/search/flight_stream.h"
#include "simd/kernel/search/packet_stream.h"
#include "simd/kernel/search/ray_sets.h"
#include "simd/kernel/tuning.h"

/// Streams of rays of which nothing is promised: they go as sets, as packets, or, for nearest hits,
/// fly. Now and then some rays are traced each way, and what did best traces the next ones. Which
/// way a ray goes changes nothing but the time.
namespace boule::BOULE_KERNEL_ISA {

enum class Way : std::size_t { set, packet, flight };

/// What trials have found out: which way takes the least time, and for how many rays that is
/// believed.
template <bool any>
class Choice {
 public:
  static constexpr std::size_t ways = any ? 2 : 3;  ///< for any hit flights are sets

  /// Takes a trial of `rays` rays that took so many steps of flights.
  void add(Way way, std::size_t rays, float steps) {
    Cost& cost = cost_[static_cast<std::size_t>(way)];
    cost.steps = cost.steps * tuning::share_of_earlier_trials + steps / static_cast<float>(rays);
    cost.trials = cost.trials * tuning::share_of_earlier_trials + 1;
  }
  /// Chooses among the first `tried` ways, of which each has been tried once more.
  void choose(std::size_t tried) {
    std::size_t best = 0;
    for (std::size_t way = 1; way < tried; ++way) best = of(way) < of(best) ? way : best;
    const auto current = static_cast<std::size_t>(way_);
    const bool gains = of(best) * tuning::gain_to_change<any> < of(current);
    if (current < tried && !gains) best = current;
    bool is_clear = true;
    for (std::size_t way = 0; way < tried; ++way)
      is_clear = is_clear && (way == best || tuning::clearly_more * of(best) < of(way));
    rays_ = best == current ? tuning::growth_while_agreed * rays_ : tuning::rays_after_trial;
    if (is_clear || rays_ > tuning::most_after_trial) rays_ = tuning::most_after_trial;
    way_ = static_cast<Way>(best);
  }
  [[nodiscard]] Way way() const { return way_; }
  /// How many rays go that way before the next trials.
  [[nodiscard]] std::size_t rays() const { return rays_; }

 private:
  struct Cost {
    float steps = 0, trials = 0;
  };
  /// Of a ray, in steps of flights.
  [[nodiscard]] float of(std::size_t way) const { return cost_[way].steps / cost_[way].trials; }

  Cost cost_[ways];
  Way way_ = Way::set;
  // As if trials had preferred sets before, so that those that agree make it rays_after_trial.
  std::size_t rays_ = tuning::rays_after_trial / tuning::growth_while_agreed;
};

/// Traces rays as packets. Returns what they cost, in steps of rays in flight.
template <class Geometry, class Answers>
BOULE_INLINE float trace_packets(const Geometry& geometry, const PaddedStream& stream,
                                 std::size_t begin, std::size_t end, const Answers& answers) {
  constexpr tuning::CostOfRay cost = tuning::cost_of_ray<RaySets<Answers>::any_hit>;
  const std::size_t visits =
      trace_groups<Solver::robust>(geometry, stream, begin, end, Form::automatic, answers);
  return static_cast<float>(visits) * cost.packet_visit +
         static_cast<float>(end - begin) * cost.packet;
}

/// Traces rays of one stream in any of the ways.
template <class Answers>
class ScatteredStream {
 public:
  static constexpr bool any_hit = RaySets<Answers>::any_hit;

  ScatteredStream(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry),
        stream_(stream),
        answers_(answers),
        flights_(geometry, stream, answers),
        sets_(geometry, stream, answers) {}

  /// Traces rays begin .. end - 1. Returns what they cost, in steps of rays in flight. For any hit
  /// there is no way `flight`.
  float run(Way way, std::size_t begin, std::size_t end) {
    if (way == Way::set) return cost_of(sets_.run(begin, end), end - begin);
    if constexpr (!any_hit) {
      if (way == Way::flight)
        return static_cast<float>(flights_.run(begin, end)) +
               static_cast<float>(end - begin) * cost.flight;
    }
    return trace_packets(geometry_, stream_, begin, end, answers_);
  }
  /// Traces rays begin .. end - 1 the way that trials among them find best.
  void run_by_trial(std::size_t begin, std::size_t end) {
    Choice<any_hit> choice;
    const auto next = [&](std::size_t rays) { return end - begin < rays ? end : begin + rays; };
    while (begin < end) {
      std::size_t until = next(tuning::set_on_trial<any_hit>), tried = 1;
      const SetEffort effort = sets_.run(begin, until);
      choice.add(Way::set, until - begin, cost_of(effort, until - begin));
      const bool shares = tuning::steps_of_shared_visit * effort.visits < effort.steps;
      for (const Way way : {Way::packet, Way::flight}) {
        begin = until;
        if (begin == end) return;
        if (way == Way::flight && (any_hit || shares)) break;
        until = next(tuning::rays_on_trial);
        choice.add(way, until - begin, run(way, begin, until));
        ++tried;
      }
      begin = until;
      choice.choose(tried);
      until = next(choice.rays());
      run(choice.way(), begin, until);
      begin = until;
    }
  }

 private:
  static constexpr tuning::CostOfRay cost = tuning::cost_of_ray<any_hit>;

  static float cost_of(const SetEffort& effort, std::size_t rays) {
    return static_cast<float>(effort.steps) * cost.set_step +
           static_cast<float>(effort.visits) * cost.set_visit + static_cast<float>(rays) * cost.set;
  }

  struct NoFlights {
    NoFlights(const GeometryView&, const PaddedStream&, const Answers&) {}
  };

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  std::conditional_t<any_hit, NoFlights, Flights> flights_;
  RaySets<Answers> sets_;
};

/// Traces rays begin .. end - 1; `begin` is a multiple of W. `form`: automatic, or flight or set,
/// which have no trials.
template <class Answers>
BOULE_NOINLINE void trace_scattered(const GeometryView& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, Form form,
                                    const Answers& answers) {
  ScatteredStream<Answers> rays(geometry, stream, answers);
  if (form == Form::automatic) {
    rays.run_by_trial(begin, end);
  } else {
    const bool fly = form == Form::flight && !ScatteredStream<Answers>::any_hit;
    rays.run(fly ? Way::flight : Way::set, begin, end);
  }
}
/// The same through parts: as packets.
template <class Answers>
BOULE_INLINE void trace_scattered(const PartsGeometry& geometry, const PaddedStream& stream,
                                  std::size_t begin, std::size_t end, Form form,
                                  const Answers& answers) {
  trace_groups<Solver::robust>(geometry, stream, begin, end, form, answers);
}

/// Rays that show what others cost: so many at each of some places of a stream.
struct Samples {
  std::size_t places, rays;
};

/// Calls run(first, last + 1) for samples of rays begin .. end - 1, which returns their cost.
/// Returns that of a ray.
template <class Run>
BOULE_INLINE float cost_of_samples(std::size_t begin, std::size_t end, const Samples& samples,
                                   const Run& run) {
  const std::size_t apart = (end - begin) / samples.places / width * width;
  float cost = 0;
  for (std::size_t k = 0; k < samples.places; ++k, begin += apart)
    cost += run(begin, begin + samples.rays);
  return cost / static_cast<float>(samples.places * samples.rays);
}

/// Traces samples of rays begin .. end - 1 one way. Returns what a ray cost.
template <class Answers>
BOULE_NOINLINE float trace_samples(const GeometryView& geometry, const PaddedStream& stream,
                                   std::size_t begin, std::size_t end, Way way,
                                   const Samples& samples, const Answers& answers) {
  ScatteredStream<Answers> rays(geometry, stream, answers);
  return cost_of_samples(begin, end, samples, [&](std::size_t first, std::size_t until) {
    return rays.run(way, first, until);
  });
}
/// The same through parts: as packets.
template <class Answers>
BOULE_NOINLINE float trace_samples(const PartsGeometry& geometry, const PaddedStream& stream,
                                   std::size_t begin, std::size_t end, Way /*way*/,
                                   const Samples& samples, const Answers& answers) {
  return cost_of_samples(begin, end, samples, [&](std::size_t first, std::size_t until) {
    return trace_packets(geometry, stream, first, until, answers);
  });
}

}  // namespace boule::BOULE_KERNEL_ISA
