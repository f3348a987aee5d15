// Rays without a promise of coherence: sets, flights and sorted rays, and the trials between these
// and packets.
#include "simd/kernel/search/flock/scattered_stream.h"

#include <type_traits>

#include "simd/kernel/search/flock/flight_stream.h"
#include "simd/kernel/search/flock/ray_sets.h"
#include "simd/kernel/search/flock/sorted_rays.h"
#include "simd/kernel/search/flock/trial.h"
#include "simd/kernel/tuning.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

/// Decides which way the rays of a stream go. From time to time it sends some rays each way, one
/// way after the other, and their times decide the way of the next rays.
template <bool any>
class Choice {
 public:
  explicit Choice(Experience& known) : known_(known) {}

  [[nodiscard]] bool is_trial() const { return known_.left == 0; }
  [[nodiscard]] Way way() const {
    return static_cast<Way>(is_trial() ? known_.next_way : known_.way);
  }
  /// The number of rays that go the current way, if the stream has that many: a multiple of W.
  [[nodiscard]] std::size_t rays() const {
    if (!is_trial()) return (known_.left + width - 1) / width * width;
    return tuning::rays_on_trial<any>[known_.next_way];
  }

  /// Records rays that went the current way, and the ticks they took. `shared`: of a set, whether
  /// its rays shared so many visits that flights cannot gain, but sorted rays may. For any hit
  /// there are neither.
  void add(std::size_t rays, float ticks, bool shared) {
    if (!is_trial()) {
      known_.left -= known_.left < rays ? known_.left : static_cast<std::uint32_t>(rays);
      return;
    }
    add_to(known_.cost[place(known_.next_way)], static_cast<float>(rays), ticks);
    if (way() == Way::set)
      take_last(number(any ? Way::packet : shared ? Way::sorted : Way::flight));
    if (known_.next_way == known_.last_way) {
      choose();
    } else {
      known_.next_way = way() == Way::set ? number(Way::packet) : known_.last_way;
    }
  }

 private:
  static constexpr std::uint32_t number(Way way) { return static_cast<std::uint32_t>(way); }
  /// The place of a way's cost: flights and sorted rays, of which a trial has one, share the last.
  static constexpr std::size_t place(std::uint32_t way) { return way < 2 ? way : 2; }

  /// Sets the last way of the trial.
  void take_last(std::uint32_t way) {
    if (known_.last_way != way) known_.cost[2] = {};
    known_.last_way = way;
  }

  /// Adds a trial to the earlier ones. Either may have been interrupted, because the system also
  /// runs other programs on the processor.
  static void add_to(Experience::Cost& cost, float rays, float ticks) {
    const float before = cost.ticks / cost.rays * rays;  // NaN at first
    if (tuning::most_growth_of_cost * before < ticks) ticks = tuning::most_growth_of_cost * before;
    const bool forget = tuning::most_fall_of_cost * ticks < before;
    const float share = forget ? 0.0F : tuning::share_of_earlier_trials;
    cost.ticks = cost.ticks * share + ticks;
    cost.rays = cost.rays * share + rays;
  }
  /// Chooses among the ways that have just been tried once more.
  void choose() {
    const std::uint32_t tried[] = {number(Way::set), number(Way::packet), known_.last_way};
    std::uint32_t best = known_.way;
    bool is_tried = false;
    for (const std::uint32_t way : tried) is_tried = is_tried || way == best;
    if (!is_tried) best = tried[0];
    const std::uint32_t current = best;
    for (const std::uint32_t way : tried) best = of(way) < of(best) ? way : best;
    if (is_tried && !(of(best) * tuning::gain_to_change<any> < of(current))) best = current;
    const bool is_first = known_.rays == 0;
    bool is_clear = !is_first;
    for (const std::uint32_t way : tried)
      is_clear = is_clear && (way == best || costs_clearly_less(of(best), of(way)));
    // The first trial starts as if earlier trials had preferred sets. It runs before the caches
    // hold any of the tree, so that the next one follows at once.
    const std::uint32_t rays =
        is_first ? 1
                 : rays_after_trial(best == known_.way, known_.rays, is_clear,
                                    tuning::least_after_trial, tuning::most_after_trial);
    known_.way = best;
    known_.rays = known_.left = rays;
    known_.next_way = 0;
    if (is_first) {
      for (Experience::Cost& cost : known_.cost) cost = {};
    }
  }
  /// The cost of one ray.
  [[nodiscard]] float of(std::uint32_t way) const {
    return known_.cost[place(way)].ticks / known_.cost[place(way)].rays;
  }

  Experience& known_;
};

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
        sets_(geometry, stream, answers),
        sorted_(geometry, stream, answers) {}

  /// Traces rays begin .. end - 1. For any hit, the ways `flight` and `sorted` do not exist.
  /// Returns whether the rays share so many visits that flights cannot gain.
  bool run(Way way, std::size_t begin, std::size_t end) {
    if (way == Way::set) {
      const SetEffort effort = sets_.run(begin, end);
      return tuning::steps_of_shared_visit * effort.visits < effort.steps;
    }
    if constexpr (!any_hit) {
      if (way == Way::flight) {
        flights_.run(begin, end);
        return false;
      }
      if (way == Way::sorted) {
        sorted_.run(begin, end);
        return false;
      }
    }
    trace_groups(geometry_, stream_, begin, end, Solver::robust, Form::automatic, answers_);
    return false;
  }
  /// Traces rays begin .. end - 1 in the way that is fastest by trials among them and before them.
  void run_by_trial(std::size_t begin, std::size_t end, Experience& known) {
    Choice<any_hit> choice(known);
    while (begin < end) {
      const std::size_t rays = end - begin < choice.rays() ? end - begin : choice.rays();
      const std::uint64_t start = ticks();
      const bool shared = run(choice.way(), begin, begin + rays);
      choice.add(rays, ticks_since(start), shared);
      begin += rays;
    }
  }

 private:
  struct None {
    None(const GeometryView&, const PaddedStream&, const Answers&) {}
  };

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  std::conditional_t<any_hit, None, Flights> flights_;
  RaySets<Answers> sets_;
  std::conditional_t<any_hit, None, SortedRays> sorted_;
};

}  // namespace

template <class Answers>
void trace_scattered(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                     std::size_t end, Form form, Experience* known, const Answers& answers) {
  ScatteredStream<Answers> rays(geometry, stream, answers);
  if (form == Form::automatic) {
    Experience own;
    rays.run_by_trial(begin, end, known == nullptr ? own : *known);
  } else {
    const bool fly = form == Form::flight && !ScatteredStream<Answers>::any_hit;
    rays.run(fly ? Way::flight : Way::set, begin, end);
  }
}

template void trace_scattered(const GeometryView&, const PaddedStream&, std::size_t, std::size_t,
                              Form, Experience*, const HitStream&);
template void trace_scattered(const GeometryView&, const PaddedStream&, std::size_t, std::size_t,
                              Form, Experience*, std::uint8_t* const&);

}  // namespace boule::BOULE_KERNEL_ISA
