#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/bundle/bundle_search.h"
#include "simd/kernel/search/flock/scattered_stream.h"
#include "simd/kernel/search/packet/packet_stream.h"

/// Streams of coherent rays, bundle by bundle. Chosen where the caller promises a common origin,
/// direction or end (Coherence) and leaves the form open. Rays that form no bundle are halved until
/// they do, few rays are traced as packets, and rays of sparse bundles as sets. The hits do not
/// depend on the partition into bundles. shadow_stream.h handles shadow rays.
namespace boule::BOULE_KERNEL_ISA {

/// Traces rays that fit into no bundle, as packets. Geometry, here and below: GeometryView, or
/// PartsGeometry.
template <class Geometry, class Answers>
BOULE_INLINE void trace_rest(const Geometry& geometry, const PaddedStream& stream,
                             std::size_t begin, std::size_t end, Answers answers) {
  trace_groups(geometry, stream, begin, end, Solver::robust, Form::automatic, answers);
}

/// Traces rays whose bundle was too sparse: as sets, or as packets where there are several parts.
template <class Answers>
BOULE_INLINE void trace_sparse(const GeometryView& geometry, const PaddedStream& stream,
                               std::size_t begin, std::size_t end, Answers answers) {
  trace_scattered(geometry, stream, begin, end, Form::set, nullptr, answers);
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

/// Traces rays begin .. end - 1, at most bundle_size: as a bundle, or halved until they form one,
/// or as packets if they are few or their bundle gave up. Returns `end`, or the first ray without
/// an answer if that ray and those after it would be in a sparse bundle.
template <Common common, class Geometry, class Answers>
std::size_t trace_halved(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                         std::size_t end, Answers answers) {
  const std::size_t count = end - begin;
  if (count >= tuning::fewest_bundle_rays) {
    Effort effort;
    const Outcome outcome = trace_in_order<common>(geometry, stream, begin, count, effort, answers);
    if (outcome == Outcome::traced) return end;
    if (outcome == Outcome::sparse) return begin;
    if (outcome == Outcome::no_bundle) {
      const std::size_t middle = begin + (count / 2 + max_width - 1) / max_width * max_width;
      const std::size_t rest = trace_halved<common>(geometry, stream, begin, middle, answers);
      return rest < middle ? rest : trace_halved<common>(geometry, stream, middle, end, answers);
    }
  }
  trace_rest(geometry, stream, begin, end, answers);
  return end;
}

/// Finds the nearest hits of all rays.
template <Common common, class Geometry>
BOULE_INLINE void closest_hit_bundled(const Geometry& geometry, const PaddedStream& stream,
                                      const HitStream& hits) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += bundle_size) {
    const std::size_t end = size - begin < bundle_size ? size : begin + bundle_size;
    const std::size_t rest = trace_halved<common>(geometry, stream, begin, end, hits);
    if (rest < end) trace_sparse(geometry, stream, rest, end, hits);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
