#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle_search.h"
#include "simd/kernel/search/packet_stream.h"
#include "simd/kernel/search/ray_pool.h"

/// Streams of rays that have something in common: bundle by bundle. Which rays share one is a
/// question of time only.
namespace boule::BOULE_KERNEL_ISA {

/// Fewer rays are packets.
inline constexpr std::size_t fewest_rays = 32;

/// Rays that have more leaves in their way than one for so many of them are sorted.
inline constexpr std::size_t rays_per_leaf_in_place = 12;

/// What does not fit into bundles goes as packets.
template <class Answers>
BOULE_INLINE void trace_rest(const GeometryView& geometry, const PaddedStream& stream,
                             std::size_t begin, std::size_t end, Answers answers) {
  trace_groups<Solver::robust>(geometry, stream, begin, end, Form::automatic, answers);
}

/// Rays of the stream as one bundle.
template <Common common, class Answers>
BOULE_INLINE Outcome trace_in_place(const GeometryView& geometry, const PaddedStream& stream,
                                    std::size_t first, std::size_t count, Effort& effort,
                                    Answers answers) {
  return trace_bundle<common>(geometry, RaysInPlace<common>(stream, first, count), effort, answers);
}

/// Rays begin .. end - 1, at most a bundle: halved until they fit; packets where they are too few,
/// or better off.
template <Common common, class Answers>
void trace_halved(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                  std::size_t end, Answers answers) {
  const std::size_t count = end - begin;
  if (count >= fewest_rays) {
    Effort effort;
    const Outcome outcome = trace_in_place<common>(geometry, stream, begin, count, effort, answers);
    if (outcome == Outcome::traced) return;
    if (outcome == Outcome::no_bundle) {
      const std::size_t middle = begin + (count / 2 + max_width - 1) / max_width * max_width;
      trace_halved<common>(geometry, stream, begin, middle, answers);
      trace_halved<common>(geometry, stream, middle, end, answers);
      return;
    }
  }
  trace_rest(geometry, stream, begin, end, answers);
}

/// The nearest hits of all rays, in their order.
template <Common common>
BOULE_INLINE void closest_hit_bundled(const GeometryView& geometry, const PaddedStream& stream,
                                      const HitStream& hits) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += bundle_size) {
    const std::size_t end = size - begin < bundle_size ? size : begin + bundle_size;
    trace_halved<common>(geometry, stream, begin, end, hits);
  }
}

/// Whether rays begin .. end - 1 meet anything, in their order, as long as that goes well: returns
/// the first ray that still waits for an answer.
template <Common common>
BOULE_INLINE std::size_t any_hit_in_place(const GeometryView& geometry, const PaddedStream& stream,
                                          std::size_t begin, std::size_t end,
                                          std::uint8_t* occluded) {
  while (end - begin >= fewest_rays) {
    const std::size_t count = end - begin < bundle_size ? end - begin : bundle_size;
    Effort effort{count / rays_per_leaf_in_place};
    if (trace_in_place<common>(geometry, stream, begin, count, effort, occluded) != Outcome::traced)
      break;
    begin += count;
  }
  return begin;
}

/// Rays first .. first + count - 1 of a pool whose bundle went that way, with all there is to know
/// of them: halved if they are no bundle, else as packets.
template <Common common>
BOULE_NOINLINE void trace_gathered(const GeometryView& geometry, const RayPool<common>& pool,
                                   std::size_t first, std::size_t count, Outcome outcome,
                                   std::uint8_t* occluded) {
  GatheredRays<bundle_size> rays;
  for (std::size_t k = 0; k < count; ++k) rays.set(k, pool.stream(), pool.index(first + k));
  const PaddedStream stream(rays.view(count));
  std::uint8_t met[bundle_size];
  if (outcome == Outcome::no_bundle) {
    trace_halved<common>(geometry, stream, 0, count, met);
  } else {
    trace_rest(geometry, stream, 0, count, met);
  }
  for (std::size_t k = 0; k < count; ++k) occluded[pool.index(first + k)] = met[k];
}

/// Whether rays begin .. end - 1, at most a pool, meet anything, sorted.
template <Common common>
BOULE_NOINLINE void any_hit_sorted(const GeometryView& geometry, const PaddedStream& stream,
                                   std::size_t begin, std::size_t end, std::uint8_t* occluded) {
  const RayPool<common> pool(stream, begin, end);
  for (std::size_t done = 0; done < pool.size(); done += bundle_size) {
    const std::size_t rest = pool.size() - done, count = rest < bundle_size ? rest : bundle_size;
    Outcome outcome = Outcome::no_bundle;
    if (pool.all_belong() && count >= fewest_rays) {
      const RaysOfPool<common> rays(pool, done, static_cast<int>(count));
      Effort effort;
      outcome = trace_bundle<common>(geometry, rays, effort, occluded);
    }
    if (outcome != Outcome::traced) trace_gathered(geometry, pool, done, count, outcome, occluded);
  }
}

/// Whether rays meet anything: where neighbours have too little in common, sorted.
template <Common common>
BOULE_INLINE void any_hit_bundled(const GeometryView& geometry, const PaddedStream& stream,
                                  std::uint8_t* occluded) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += pool_size) {
    const std::size_t end = size - begin < pool_size ? size : begin + pool_size;
    const std::size_t rest = any_hit_in_place<common>(geometry, stream, begin, end, occluded);
    if (end - rest < fewest_rays) {
      trace_rest(geometry, stream, rest, end, occluded);
    } else {
      any_hit_sorted<common>(geometry, stream, rest, end, occluded);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
