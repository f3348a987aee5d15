#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle_search.h"
#include "simd/kernel/search/flight_stream.h"
#include "simd/kernel/search/packet_stream.h"
#include "simd/kernel/search/ray_pool.h"

/// Streams of rays with something in common, bundle by bundle. Chosen where the caller promises a
/// common origin, direction or end (Coherence) and asks for no other form. Rays that are no bundle
/// after all are halved until they are, few rays go as packets, and those of sparse bundles fly.
/// The hits do not depend on which rays make a bundle. Shadow rays (any hit) are taken in their
/// order as long as that goes well, and then sorted (ray_pool.h).
namespace boule::BOULE_KERNEL_ISA {

/// Traces rays that fit into no bundle, as packets. Geometry, here and below: GeometryView, or
/// PartsGeometry.
template <class Geometry, class Answers>
BOULE_INLINE void trace_rest(const Geometry& geometry, const PaddedStream& stream,
                             std::size_t begin, std::size_t end, Answers answers) {
  trace_groups<Solver::robust>(geometry, stream, begin, end, Form::automatic, answers);
}

/// Traces rays whose bundle was too sparse: in flight, or as packets where there are several parts.
template <class Answers>
BOULE_NOINLINE void trace_sparse(const GeometryView& geometry, const PaddedStream& stream,
                                 std::size_t begin, std::size_t end, Answers answers) {
  Flights<Answers>(geometry, stream, answers).run(begin, end);
}
template <class Answers>
BOULE_INLINE void trace_sparse(const PartsGeometry& geometry, const PaddedStream& stream,
                               std::size_t begin, std::size_t end, Answers answers) {
  trace_rest(geometry, stream, begin, end, answers);
}

/// Traces `count` rays of the stream as one bundle.
template <Common common, class Geometry, class Answers>
BOULE_INLINE Outcome trace_in_order(const Geometry& geometry, const PaddedStream& stream,
                                    std::size_t first, std::size_t count, Effort& effort,
                                    Answers answers) {
  return trace_bundle<common>(geometry, RaysInOrder<common>(stream, first, count), effort, answers);
}

/// Traces rays begin .. end - 1, at most bundle_size: as a bundle, or halved until they are one, or
/// as packets where they are few or their bundle gave up. `sparse`: whether a bundle was sparse;
/// from there on there are no bundles.
template <Common common, class Geometry, class Answers>
void trace_halved(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                  std::size_t end, Answers answers, bool& sparse) {
  const std::size_t count = end - begin;
  if (count >= tuning::fewest_bundle_rays) {
    Effort effort;
    const Outcome outcome =
        sparse ? Outcome::sparse
               : trace_in_order<common>(geometry, stream, begin, count, effort, answers);
    if (outcome == Outcome::traced) return;
    if (outcome == Outcome::sparse) {
      sparse = true;
      trace_sparse(geometry, stream, begin, end, answers);
      return;
    }
    if (outcome == Outcome::no_bundle) {
      const std::size_t middle = begin + (count / 2 + max_width - 1) / max_width * max_width;
      trace_halved<common>(geometry, stream, begin, middle, answers, sparse);
      trace_halved<common>(geometry, stream, middle, end, answers, sparse);
      return;
    }
  }
  trace_rest(geometry, stream, begin, end, answers);
}

/// Finds the nearest hits of all rays.
template <Common common, class Geometry>
BOULE_INLINE void closest_hit_bundled(const Geometry& geometry, const PaddedStream& stream,
                                      const HitStream& hits) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += bundle_size) {
    const std::size_t end = size - begin < bundle_size ? size : begin + bundle_size;
    bool sparse = false;
    trace_halved<common>(geometry, stream, begin, end, hits, sparse);
  }
}

/// Finds whether rays begin .. end - 1 hit anything, in their order, as long as that goes well.
/// Returns the first ray that has no answer yet.
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

/// Traces rays first .. first + count - 1 of a pool, whose bundle had this outcome: as packets if
/// it gave up, else as trace_halved() does, which `sparse` is for.
template <Common common, class Geometry>
BOULE_NOINLINE void trace_gathered(const Geometry& geometry, const RayPool<common>& pool,
                                   std::size_t first, std::size_t count, Outcome outcome,
                                   std::uint8_t* occluded, bool& sparse) {
  GatheredRays<bundle_size> rays;
  for (std::size_t k = 0; k < count; ++k) rays.set(k, pool.stream(), pool.index(first + k));
  const PaddedStream stream(rays.view(count));
  std::uint8_t met[bundle_size];
  if (outcome == Outcome::gave_up) {
    trace_rest(geometry, stream, 0, count, met);
  } else {
    trace_halved<common>(geometry, stream, 0, count, met, sparse);
  }
  for (std::size_t k = 0; k < count; ++k) occluded[pool.index(first + k)] = met[k];
}

/// Finds whether rays begin .. end - 1, at most a pool, hit anything: sorted by where they lie for
/// their light. Where one bundle is sparse, all that come after it fly.
template <Common common, class Geometry>
BOULE_NOINLINE void any_hit_sorted(const Geometry& geometry, const PaddedStream& stream,
                                   std::size_t begin, std::size_t end, std::uint8_t* occluded) {
  const RayPool<common> pool(stream, begin, end);
  bool sparse = false;
  for (std::size_t done = 0; done < pool.size(); done += bundle_size) {
    const std::size_t rest = pool.size() - done, count = rest < bundle_size ? rest : bundle_size;
    Outcome outcome = Outcome::no_bundle;
    if (!sparse && pool.all_belong() && count >= tuning::fewest_bundle_rays) {
      const RaysOfPool<common> rays(pool, done, static_cast<int>(count));
      Effort effort;
      outcome = trace_bundle<common>(geometry, rays, effort, occluded);
    }
    sparse = sparse || outcome == Outcome::sparse;
    if (outcome != Outcome::traced)
      trace_gathered(geometry, pool, done, count, outcome, occluded, sparse);
  }
}

/// Finds whether rays hit anything: in their order, and sorted from where neighbours have too
/// little in common.
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
      any_hit_sorted<common>(geometry, stream, rest, end, occluded);
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
