#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/kernel/search/bundle/bundle_stream.h"
#include "simd/kernel/search/bundle/ray_pool.h"
#include "simd/kernel/search/flock/scattered_stream.h"
#include "simd/kernel/search/flock/trial.h"
#include "simd/kernel/tuning.h"

/// Streams of coherent shadow rays (any hit). Bundles take them in their order as long as
/// neighbours are coherent. From there on the rays are sorted for their light (ray_pool.h), or go
/// unsorted, as rays without a promise. From time to time some go each way, and the faster way
/// takes the next ones. The way of a ray affects only the time.
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

/// The cost of some work of a few parts, each of many units. The system also runs other programs on
/// the processor: if it interrupted one part, a unit of it counts as one of the next dearest part.
class Costs {
 public:
  void add(float ticks, float units) {
    const float each = ticks / units;
    ticks_ += ticks;
    if (most_ < each) {
      second_ = most_;
      most_ = each;
      units_ = units;
    } else if (second_ < each) {
      second_ = each;
    }
  }
  [[nodiscard]] float ticks() const {
    const bool interrupted = 0 < second_ && tuning::interrupted * second_ < most_;
    return interrupted ? ticks_ - (most_ - second_) * units_ : ticks_;
  }

 private:
  float ticks_ = 0;
  float most_ = 0, second_ = 0;  ///< of a unit
  float units_ = 0;              ///< of the most expensive part
};

/// Traces rays begin .. end - 1 in their order, as rays without a promise.
template <class Geometry>
BOULE_INLINE void trace_unsorted(const Geometry& geometry, const PaddedStream& stream,
                                 std::size_t begin, std::size_t end, Experience& known,
                                 std::uint8_t* occluded) {
  if (geometry.bvh.size == 0) {
    trace_rest(geometry, stream, begin, end, occluded);
  } else {
    trace_scattered(geometry, stream, begin, end, Form::automatic, &known, occluded);
  }
}

/// Samples from all over the rays begin .. end - 1. They go unsorted and show what such a ray
/// costs. The other rays follow if sorting does not pay.
template <class Geometry>
class UnsortedSamples {
 public:
  UnsortedSamples(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                  std::size_t end, Experience& known, std::uint8_t* occluded)
      : geometry_(geometry),
        stream_(stream),
        known_(known),
        occluded_(occluded),
        begin_(begin),
        end_(end),
        apart_((end - begin) / size / width * width),
        rays_(tuning::rays_of_sample(end - begin)) {}

  /// Traces the samples. Returns the ticks of a ray.
  BOULE_NOINLINE float trace() const {
    Costs costs;
    for (std::size_t k = 0; k < size; ++k) {
      // The rays before a sample bring what it visits into the caches.
      run(first(k), first(k) + rays_);
      const std::uint64_t start = ticks();
      run(first(k) + rays_, first(k) + 2 * rays_);
      costs.add(ticks_since(start), static_cast<float>(rays_));
    }
    return costs.ticks() / static_cast<float>(size * rays_);
  }
  /// Traces the other rays.
  BOULE_NOINLINE void trace_others() const {
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t end = k + 1 < size ? first(k + 1) : end_;
      trace_unsorted(geometry_, stream_, first(k) + 2 * rays_, end, known_, occluded_);
    }
  }

 private:
  static constexpr std::size_t size = 4;

  [[nodiscard]] std::size_t first(std::size_t k) const { return begin_ + k * apart_; }
  /// The way that trials prefer, or sets if there was none: a trial in the midst of a sample would
  /// count as what its rays cost.
  BOULE_NOINLINE void run(std::size_t first, std::size_t end) const {
    if (known_.rays != 0 && static_cast<Way>(known_.way) == Way::packet) {
      trace_rest(geometry_, stream_, first, end, occluded_);
    } else {
      trace_sparse(geometry_, stream_, first, end, occluded_);
    }
  }

  const Geometry& geometry_;
  const PaddedStream& stream_;
  Experience& known_;
  std::uint8_t* const occluded_;
  std::size_t begin_, end_, apart_, rays_;
};

/// The bundles of a sorted pool, those with the densest rays first. A few from all over this order,
/// all if there are no more, come before all others: the pool is judged by them.
template <Common common>
class PoolBundles {
 public:
  explicit PoolBundles(const RayPool<common>& pool) : pool_(pool) {
    for (; size_ * bundle_size < pool.size(); ++size_) {
      std::size_t at = size_;
      for (; at > 0 && area(size_) < area(order_[at - 1]); --at) order_[at] = order_[at - 1];
      order_[at] = size_;
    }
    for (std::size_t k = 0; k < judges(); ++k) {
      const std::size_t at = (2 * k + 1) * size_ / (2 * judges()), judge = order_[at];
      order_[at] = order_[k];
      order_[k] = judge;
    }
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The number of bundles that the pool is judged by.
  [[nodiscard]] std::size_t judges() const {
    return size_ < tuning::bundles_judged ? size_ : tuning::bundles_judged;
  }
  /// The first ray of the k-th bundle, and the number of its rays.
  [[nodiscard]] std::size_t first(std::size_t k) const { return order_[k] * bundle_size; }
  [[nodiscard]] std::size_t count(std::size_t k) const { return rays(order_[k]); }

 private:
  [[nodiscard]] std::size_t rays(std::size_t bundle) const {
    const std::size_t rest = pool_.size() - bundle * bundle_size;
    return rest < bundle_size ? rest : bundle_size;
  }
  [[nodiscard]] unsigned area(std::size_t bundle) const {
    return pool_.cells(bundle * bundle_size, rays(bundle));
  }

  const RayPool<common>& pool_;
  std::size_t size_ = 0;
  std::size_t order_[tuning::pool_size / bundle_size];
};

/// The answer of rays that no bundle took.
inline constexpr std::uint8_t unanswered = 2;

/// Traces rays first .. first + count - 1 of a sorted pool as one bundle.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome trace_sorted(const Geometry& geometry, const RayPool<common>& pool,
                                    std::size_t first, std::size_t count, Effort& effort,
                                    std::uint8_t* occluded) {
  const RaysOfPool<common> rays(pool, first, static_cast<int>(count));
  return trace_bundle<common>(geometry, rays, effort, occluded);
}

/// The same, halved until they form bundles. Returns the number of rays that remain unanswered.
template <Common common, class Geometry>
std::size_t trace_sorted_halves(const Geometry& geometry, const RayPool<common>& pool,
                                std::size_t first, std::size_t count, Effort& effort,
                                std::uint8_t* occluded) {
  if (count < tuning::fewest_bundle_rays) return count;
  const Outcome outcome = trace_sorted(geometry, pool, first, count, effort, occluded);
  if (outcome == Outcome::traced) return 0;
  if (outcome != Outcome::no_bundle) return count;
  const std::size_t half = (count / 2 + max_width - 1) / max_width * max_width;
  return trace_sorted_halves(geometry, pool, first, half, effort, occluded) +
         trace_sorted_halves(geometry, pool, first + half, count - half, effort, occluded);
}

/// Sorts rays begin .. end - 1, at most a pool, by their place as their light sees it, and finds
/// whether they hit anything. Returns the ticks that a ray seems to take; 0: fewer than two bundles
/// could tell; infinity: rays that share nothing. Stops if these are more than `most`. Adds the
/// number of rays that no bundle takes, which remain unanswered, to `open`.
template <Common common, class Geometry>
BOULE_NOINLINE float any_hit_sorted(const Geometry& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, float most,
                                    std::size_t& open, std::uint8_t* occluded) {
  const std::uint64_t before = ticks();
  const RayPool<common> pool(stream, begin, end);
  if (!pool.all_belong()) return std::numeric_limits<float>::infinity();
  const PoolBundles<common> bundles(pool);
  const float sorting = ticks_since(before) / static_cast<float>(end - begin);
  float cost = 0, judged = 0;
  Costs costs;
  for (std::size_t k = 0; k < bundles.size() && cost <= most; ++k) {
    Effort effort;
    const std::uint64_t start = ticks();
    const std::size_t count = bundles.count(k);
    const std::size_t left =
        trace_sorted_halves(geometry, pool, bundles.first(k), count, effort, occluded);
    open += left;
    if (k >= bundles.judges()) continue;
    costs.add(ticks_since(start) + static_cast<float>(left) * most,
              static_cast<float>(effort.leaves + 1));
    judged += static_cast<float>(count);
    if (k > 0) cost = sorting + costs.ticks() / judged;
  }
  return cost;
}

/// Traces the rays among begin .. end - 1 that are unanswered, unsorted.
template <class Geometry>
BOULE_NOINLINE void trace_unanswered(const Geometry& geometry, const PaddedStream& stream,
                                     std::size_t begin, std::size_t end, Experience& known,
                                     std::uint8_t* occluded) {
  GatheredRays<bundle_size> rays;
  std::size_t index[bundle_size], count = 0;
  const auto trace = [&] {
    std::uint8_t met[bundle_size];
    const PaddedStream some(rays.view(count));
    trace_unsorted(geometry, some, 0, count, known, met);
    for (std::size_t k = 0; k < count; ++k) occluded[index[k]] = met[k];
    count = 0;
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (occluded[i] != unanswered) continue;
    rays.set(count, stream.rays(), i);
    index[count++] = i;
    if (count == bundle_size) trace();
  }
  if (count != 0) trace();
}

/// Records a trial that found that a ray takes `cost` ticks if it is sorted.
BOULE_INLINE void learn(float cost, Experience::Sorting& sorting) {
  const std::uint32_t pays = cost <= sorting.most ? 1 : 0;
  const bool is_clear =
      costs_clearly_less(cost, sorting.most) || costs_clearly_less(sorting.most, cost);
  sorting.rays = sorting.left =
      rays_after_trial(pays == sorting.pays, sorting.rays, is_clear, tuning::least_after_sorting,
                       tuning::most_after_sorting);
  sorting.pays = pays;
}

/// Finds whether rays begin .. end - 1, at most a pool, hit anything: sorted, or as rays without a
/// promise if these take less time. From time to time both ways are tried.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_unordered(const Geometry& geometry, const PaddedStream& stream,
                                    std::size_t begin, std::size_t end, Experience& known,
                                    std::uint8_t* occluded) {
  Experience::Sorting& sorting = known.sorting;
  const std::size_t count = end - begin;
  const bool is_trial =
      sorting.left == 0 && count >= tuning::fewest_rays_judged && geometry.bvh.size != 0;
  sorting.left -= sorting.left < count ? sorting.left : static_cast<std::uint32_t>(count);
  if (!is_trial && sorting.pays == 0)
    return trace_unsorted(geometry, stream, begin, end, known, occluded);

  __builtin_memset(occluded + begin, unanswered, count);
  const UnsortedSamples<Geometry> samples(geometry, stream, begin, end, known, occluded);
  if (is_trial) sorting.most = samples.trace();
  std::size_t open = 0;
  const float cost =
      any_hit_sorted<common>(geometry, stream, begin, end, sorting.most, open, occluded);
  if (is_trial) learn(cost, sorting);
  if (cost <= sorting.most) {
    if (open != 0) trace_unanswered(geometry, stream, begin, end, known, occluded);
  } else if (is_trial) {
    samples.trace_others();
  } else {
    sorting.left = 0;
    trace_unsorted(geometry, stream, begin, end, known, occluded);
  }
}

/// Finds whether rays hit anything: in their order as long as neighbours are coherent, and then in
/// another way.
template <Common common, class Geometry>
BOULE_INLINE void any_hit_bundled(const Geometry& geometry, const PaddedStream& stream,
                                  Experience& known, std::uint8_t* occluded) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += tuning::pool_size) {
    const std::size_t end = size - begin < tuning::pool_size ? size : begin + tuning::pool_size;
    const std::size_t rest = any_hit_in_order<common>(geometry, stream, begin, end, occluded);
    if (end - rest < tuning::fewest_bundle_rays) {
      trace_rest(geometry, stream, rest, end, occluded);
      continue;
    }
    const std::size_t judged = known.sorting.left == 0 && tuning::most_rays_judged < end - rest
                                   ? rest + tuning::most_rays_judged
                                   : end;
    any_hit_unordered<common>(geometry, stream, rest, judged, known, occluded);
    if (judged < end) any_hit_unordered<common>(geometry, stream, judged, end, known, occluded);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
