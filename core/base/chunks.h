#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/float_environment.h"
#include "core/base/parallel.h"

namespace boule {

/// The number of elements in a chunk of a loop. The partition depends only on the length of the
/// loop, so results that are put together chunk by chunk are independent of the threads.
inline constexpr std::size_t chunk_size = std::size_t{1} << 16;
constexpr std::size_t chunks_of(std::size_t count) { return (count + chunk_size - 1) / chunk_size; }

/// Calls body(chunk, begin, end) for all chunks of 0 .. count - 1, in the default float
/// environment.
template <class Body>
void in_chunks(const ParallelFor& parallel_for, std::size_t count, const Body& body) {
  parallel_for(chunks_of(count), [&](std::size_t chunk) {
    const FloatEnvironment environment;
    const std::size_t begin = chunk * chunk_size;
    body(chunk, begin, std::min(begin + chunk_size, count));
  });
}

}  // namespace boule
