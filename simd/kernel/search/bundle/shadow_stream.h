#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/kernel/search/bundle/bundle_stream.h"
#include "simd/kernel/search/bundle/ray_pool.h"
#include "simd/kernel/search/flock/scattered_stream.h"
#include "simd/kernel/tuning.h"

/// Streams of coherent shadow rays (any hit). Bundles take them in their order as long as
/// neighbours are coherent. From there on the rays are sorted for their light (ray_pool.h), unless
/// they cost less one by one. The way of a ray affects only the time.
namespace boule::BOULE_KERNEL_ISA {

/// Finds whether rays begin .. end - 1 hit anything, in their order, as long as bundles do well.
/// Returns the first ray without an answer. Geometry, here and below: GeometryView, or
/// PartsGeometry.
template <Common common, class Geometry>
BOULE_INLINE std::size_t any_hit_in_order(const Geometry& geometry, const PaddedStream& stream,
                                          std::size_t begin, std::size_t end,
                                          std::uint8_t* occluded) {
  while (end - begin >= tuning::fewest_bundle_rays) {
    const std::size_t count = end - begin < bundle_size ? end - begin : bundle_size;
    Effort effort{count / tuning::rays_per_leaf_in_order};
    if (trace_in_order<common>(geometry, stream, begin, count, effort, occluded) != Outcome::traced)
      break;
    begin += count;
  }
  return begin;
}

/// Rays that show the cost of others: `rays` of them at each of `places` places of a stream.
struct Samples {
  std::size_t places, rays;
};

/// Calls run(first, last + 1), which returns the cost, for samples of rays begin .. end - 1.
/// Returns the cost of a ray.
template <class Run>
BOULE_INLINE float cost_of_samples(std::size_t begin, std::size_t end, const Samples& samples,
                                   const Run& run) {
  const std::size_t apart = (end - begin) / samples.places / width * width;
  float cost = 0;
  for (std::size_t k = 0; k < samples.places; ++k, begin += apart)
    cost += run(begin, begin + samples.rays);
  return cost / static_cast<float>(samples.places * samples.rays);
}

/// The cost of a ray as packets, by samples of rays begin .. end - 1, which are traced.
template <class Geometry>
BOULE_NOINLINE float cost_as_packets(const Geometry& geometry, const PaddedStream& stream,
                                     std::size_t begin, std::size_t end, std::uint8_t* occluded) {
  const auto run = [&](std::size_t first, std::size_t until) {
    const std::size_t visits =
        trace_groups(geometry, stream, first, until, Solver::robust, Form::automatic, occluded);
    return static_cast<float>(visits) * tuning::cost_of_ray.packet_visit +
           static_cast<float>(until - first) * tuning::cost_of_ray.packet;
  };
  return cost_of_samples(begin, end, {tuning::packets_on_trial, width}, run);
}

/// The same as sets.
template <class Geometry>
BOULE_NOINLINE float cost_as_sets(const Geometry& geometry, const PaddedStream& stream,
                                  std::size_t begin, std::size_t end, std::uint8_t* occluded) {
  const auto run = [&](std::size_t first, std::size_t until) {
    const SetEffort effort = trace_sets(geometry, stream, first, until, occluded);
    return static_cast<float>(effort.steps) * tuning::cost_of_ray.set_step +
           static_cast<float>(effort.visits) * tuning::cost_of_ray.set_visit +
           static_cast<float>(until - first) * tuning::cost_of_ray.set;
  };
  return cost_of_samples(begin, end, {tuning::sets_on_trial, tuning::set_on_trial}, run);
}

/// The cost of an unsorted ray, by samples, and that of a sorted one: in the unit of
/// tuning::cost_of_ray.
template <class Geometry>
class UnsortedCost {
 public:
  /// Traces some of the rays begin .. end - 1, at most a pool, in the ways that may cost less than
  /// sorted bundles.
  UnsortedCost(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
               std::size_t end, std::uint8_t* occluded)
      : least_sorted_(least_of_sorted(geometry.bvh.size, end - begin)) {
    // Few rays are not worth the samples, and without a tree there are no sets.
    if (end - begin < tuning::fewest_rays_judged || geometry.bvh.size == 0) return;
    const auto consider = [&](Way way, float cost) {
      if (cost_ <= cost) return;
      cost_ = cost;
      way_ = way;
    };
    if constexpr (width >= 16)
      consider(Way::packet, cost_as_packets(geometry, stream, begin, end, occluded));
    if constexpr (std::is_same_v<Geometry, GeometryView>) {
      if (tuning::least_sorted_beside_set * tuning::cost_of_ray.set < least_sorted_)
        consider(Way::set, cost_as_sets(geometry, stream, begin, end, occluded));
    }
  }

  /// Whether unsorted rays cost less than the least possible cost of sorted rays. The more nodes
  /// per ray, the more leaves a bundle visits.
  [[nodiscard]] bool is_less_than_sorted() const { return cost_ < least_sorted_; }
  /// Whether unsorted rays cost less than whole sorted bundles that visited this many leaves each.
  [[nodiscard]] bool is_less_than_bundle(std::size_t leaves) const {
    return cost_ < tuning::bundled_ray + tuning::bundled_leaf * static_cast<float>(leaves) /
                                             static_cast<float>(bundle_size);
  }
  /// The way that costs least.
  [[nodiscard]] Way way() const { return way_; }

 private:
  static float least_of_sorted(std::size_t nodes, std::size_t rays) {
    const std::size_t shared_by =
        rays < tuning::fewest_rays_a_node ? tuning::fewest_rays_a_node : rays;
    return tuning::sorted_ray +
           tuning::sorted_ray_a_node * static_cast<float>(nodes) / static_cast<float>(shared_by);
  }

  float least_sorted_;
  float cost_ = static_cast<float>(no_hit);
  Way way_ = Way::packet;
};

/// Traces rays first .. first + count - 1 of a pool, after this outcome of their bundle: as packets
/// if it gave up, otherwise as trace_halved() does. Returns whether a bundle was sparse. Its rays
/// then have no answers: sets, whose lists take as much of the stack as a pool, are made after the
/// pool is gone.
template <Common common, class Geometry>
BOULE_NOINLINE bool trace_gathered(const Geometry& geometry, const RayPool<common>& pool,
                                   std::size_t first, std::size_t count, Outcome outcome,
                                   std::uint8_t* occluded) {
  GatheredRays<bundle_size> rays;
  for (std::size_t k = 0; k < count; ++k) rays.set(k, pool.stream(), pool.index(first + k));
  const PaddedStream stream(rays.view(count));
  std::uint8_t met[bundle_size];
  std::size_t rest = count;
  if (outcome == Outcome::gave_up) {
    trace_rest(geometry, stream, 0, count, met);
  } else {
    rest = trace_halved<common>(geometry, stream, 0, count, met);
  }
  if (rest < count) return true;
  for (std::size_t k = 0; k < count; ++k) occluded[pool.index(first + k)] = met[k];
  return false;
}

/// The bundles of a sorted pool, one by one. If there are four or more, four that lie far apart
/// come first, by which all are judged; then the others in their order.
class JudgedFirst {
 public:
  static constexpr std::size_t most = 4;
  explicit JudgedFirst(std::size_t bundles) : bundles_(bundles) {}

  /// Calls trace(bundle), which returns whether to go on, and after each judged bundle
  /// goes_on(number of judged bundles). Returns whether every call said to go on.
  template <class Trace, class GoesOn>
  bool each(const Trace& trace, const GoesOn& goes_on) const {
    const std::size_t judged = bundles_ < most ? 0 : most;
    for (std::size_t k = 0; k < judged; ++k) {
      if (!trace(judged_at(k)) || !goes_on(k + 1)) return false;
    }
    std::size_t next = 0;
    for (std::size_t bundle = 0; bundle < bundles_; ++bundle) {
      if (next < judged && bundle == judged_at(next)) {
        ++next;
      } else if (!trace(bundle)) {
        return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t judged_at(std::size_t k) const {
    return (2 * k + 1) * bundles_ / (2 * most);
  }
  std::size_t bundles_;
};

/// The numbers of leaves that some bundles visited.
class LeafCounts {
 public:
  void add(std::size_t leaves) {
    std::size_t at = size_++;
    for (; at > 0 && counts_[at - 1] > leaves; --at) counts_[at] = counts_[at - 1];
    counts_[at] = leaves;
  }
  /// The usual number, rather too low: of two the smaller, of four the second. One bundle may be an
  /// exception.
  [[nodiscard]] std::size_t usual() const { return counts_[(size_ - 1) / 2]; }

 private:
  std::size_t size_ = 0;
  std::size_t counts_[JudgedFirst::most];
};

/// Sorts rays begin .. end - 1, at most a pool, by their place as their light sees it, and finds
/// whether they hit anything. If some rays are left without an answer, the outcome is `sparse`, or
/// `gave_up` where bundles seem to cost more than `unsorted`.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome any_hit_sorted(const Geometry& geometry, const PaddedStream& stream,
                                      std::size_t begin, std::size_t end,
                                      const UnsortedCost<Geometry>& unsorted,
                                      std::uint8_t* occluded) {
  const RayPool<common> pool(stream, begin, end);
  bool sparse = false;
  std::size_t leaves = 0;  // of the last bundle
  const auto trace = [&](std::size_t bundle) {
    const std::size_t first = bundle * bundle_size, rest = pool.size() - first;
    const std::size_t count = rest < bundle_size ? rest : bundle_size;
    Outcome outcome = Outcome::no_bundle;
    Effort effort;
    if (pool.all_belong() && count >= tuning::fewest_bundle_rays) {
      const RaysOfPool<common> rays(pool, first, static_cast<int>(count));
      outcome = trace_bundle<common>(geometry, rays, effort, occluded);
    }
    leaves = effort.leaves;
    sparse = outcome == Outcome::sparse ||
             (outcome != Outcome::traced &&
              trace_gathered(geometry, pool, first, count, outcome, occluded));
    return !sparse;
  };
  LeafCounts counts;
  const auto goes_on = [&](std::size_t judged) {
    counts.add(leaves);
    return judged == 1 || !unsorted.is_less_than_bundle(counts.usual());
  };
  if (JudgedFirst((pool.size() + bundle_size - 1) / bundle_size).each(trace, goes_on))
    return Outcome::traced;
  return sparse ? Outcome::sparse : Outcome::gave_up;
}

/// Finds whether rays begin .. end - 1, at most a pool, hit anything: sorted, or as rays without a
/// promise where that seems to cost less. `known`: Query::experience.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_unordered(const Geometry& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, Experience* known,
                                    std::uint8_t* occluded) {
  const UnsortedCost<Geometry> unsorted(geometry, stream, begin, end, occluded);
  Outcome outcome = Outcome::gave_up;
  if (!unsorted.is_less_than_sorted())
    outcome = any_hit_sorted<common>(geometry, stream, begin, end, unsorted, occluded);
  if (outcome == Outcome::traced) return;
  if (outcome == Outcome::sparse || unsorted.way() == Way::set) {
    trace_sparse(geometry, stream, begin, end, occluded);
  } else {
    trace_scattered(geometry, stream, begin, end, Form::automatic, known, occluded);
  }
}

/// Finds whether rays hit anything: in their order as long as neighbours are coherent, and then in
/// another way.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_bundled(const Geometry& geometry, const PaddedStream& stream,
                                  Experience* known, std::uint8_t* occluded) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += tuning::pool_size) {
    const std::size_t end = size - begin < tuning::pool_size ? size : begin + tuning::pool_size;
    const std::size_t rest = any_hit_in_order<common>(geometry, stream, begin, end, occluded);
    if (end - rest < tuning::fewest_bundle_rays) {
      trace_rest(geometry, stream, rest, end, occluded);
    } else {
      any_hit_unordered<common>(geometry, stream, rest, end, known, occluded);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
