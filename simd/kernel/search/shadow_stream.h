#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle_stream.h"
#include "simd/kernel/search/ray_pool.h"
#include "simd/kernel/search/scattered_stream.h"
#include "simd/kernel/tuning.h"

/// Streams of shadow rays (any hit) with something in common. They are taken in their order as long
/// as bundles of neighbours do well, and from there on sorted for their light (ray_pool.h), unless
/// they cost less one by one. Which way a ray goes changes nothing but the time.
namespace boule::BOULE_KERNEL_ISA {

/// Finds whether rays begin .. end - 1 hit anything, in their order, as long as that goes well.
/// Returns the first ray that has no answer yet. Geometry, here and below: GeometryView, or
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

/// What a ray costs in a packet, in steps of flights (tuning::steps_a_packet_visit), beside sorted
/// bundles.
class PacketCost {
 public:
  /// Nothing is known, and bundles seem to cost less.
  PacketCost() = default;
  /// As some of the rays begin .. end - 1 show, which are traced.
  template <class Geometry>
  BOULE_NOINLINE PacketCost(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                            std::size_t end, std::uint8_t* occluded) {
    const std::size_t apart = (end - begin) / places / width * width;
    std::size_t visits = 0;
    for (std::size_t k = 0; k < places; ++k) {
      const std::size_t at = begin + k * apart;
      visits +=
          trace_groups<Solver::robust>(geometry, stream, at, at + width, Form::automatic, occluded);
    }
    steps_ = static_cast<float>(visits) * tuning::steps_a_packet_visit / (places * width);
  }

  /// Whether that is less than what so many rays cost at least that are sorted and go as bundles
  /// through a tree of so many nodes. The more nodes for a ray, the more leaves a bundle meets.
  [[nodiscard]] bool are_less_than_sorted(std::size_t nodes, std::size_t rays) const {
    return steps_ < tuning::steps_sorted + tuning::steps_sorted_a_node * static_cast<float>(nodes) /
                                               static_cast<float>(rays);
  }
  /// Whether that is less than what whole sorted bundles took, which visited so many leaves each.
  [[nodiscard]] bool are_less_than_bundle(std::size_t leaves) const {
    return bundle_size * (steps_ + tuning::steps_of_no_bundle) <
           static_cast<float>(leaves) * tuning::steps_a_bundled_leaf;
  }

 private:
  static constexpr std::size_t places = tuning::packets_on_trial;

  float steps_ = static_cast<float>(no_hit);  ///< a ray
};

/// Traces rays first .. first + count - 1 of a pool, whose bundle had this outcome: as packets if
/// it gave up, else as trace_halved() does. Returns whether a bundle was sparse; they then have no
/// answers: sets, whose lists take as much of the stack as a pool, are made when the pool is gone.
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

/// The bundles of a sorted pool, one by one: first, of four or more, four that lie far from each
/// other, by which all are judged, then the others in their order.
class JudgedFirst {
 public:
  static constexpr std::size_t most = 4;
  explicit JudgedFirst(std::size_t bundles) : bundles_(bundles) {}

  /// Calls trace(bundle), which returns whether to go on, and after each judged one goes_on(how
  /// many there were). Returns whether it always was to go on.
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

/// How many leaves some bundles visited.
class LeafCounts {
 public:
  void add(std::size_t leaves) {
    std::size_t at = size_++;
    for (; at > 0 && counts_[at - 1] > leaves; --at) counts_[at] = counts_[at - 1];
    counts_[at] = leaves;
  }
  /// What they visit usually, rather less than more: of two the least, of four the second. One may
  /// be of a kind of its own.
  [[nodiscard]] std::size_t usual() const { return counts_[(size_ - 1) / 2]; }

 private:
  std::size_t size_ = 0;
  std::size_t counts_[JudgedFirst::most];
};

/// Sorts rays begin .. end - 1, at most a pool, by where they lie for their light, and finds
/// whether they hit anything. With answers for some of them only, the outcome is `sparse`, or
/// `gave_up` where bundles seem to cost more than `packets`.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome any_hit_sorted(const Geometry& geometry, const PaddedStream& stream,
                                      std::size_t begin, std::size_t end, const PacketCost& packets,
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
    return judged == 1 || !packets.are_less_than_bundle(counts.usual());
  };
  if (JudgedFirst((pool.size() + bundle_size - 1) / bundle_size).each(trace, goes_on))
    return Outcome::traced;
  return sparse ? Outcome::sparse : Outcome::gave_up;
}

/// Finds whether rays begin .. end - 1, at most a pool, hit anything: sorted, or one by one where
/// that seems to cost less.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_unordered(const Geometry& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, std::uint8_t* occluded) {
  const std::size_t size = end - begin;
  PacketCost packets;
  if (size >= tuning::fewest_rays_judged &&
      geometry.bvh.size > 0)  // without a tree there are no sets
    packets = PacketCost(geometry, stream, begin, end, occluded);
  Outcome outcome = Outcome::gave_up;
  if (!packets.are_less_than_sorted(geometry.bvh.size, size))
    outcome = any_hit_sorted<common>(geometry, stream, begin, end, packets, occluded);
  if (outcome == Outcome::sparse) trace_sparse(geometry, stream, begin, end, occluded);
  if (outcome == Outcome::gave_up)
    trace_scattered(geometry, stream, begin, end, Form::automatic, occluded);
}

/// Finds whether rays hit anything: in their order, and from where neighbours have too little in
/// common in another way.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_bundled(const Geometry& geometry, const PaddedStream& stream,
                                  std::uint8_t* occluded) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += tuning::pool_size) {
    const std::size_t end = size - begin < tuning::pool_size ? size : begin + tuning::pool_size;
    const std::size_t rest = any_hit_in_order<common>(geometry, stream, begin, end, occluded);
    if (end - rest < tuning::fewest_bundle_rays) {
      trace_rest(geometry, stream, rest, end, occluded);
    } else {
      any_hit_unordered<common>(geometry, stream, rest, end, occluded);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
