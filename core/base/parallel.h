#pragma once

#include <cstddef>
#include <functional>

namespace boule {

/// Calls body(0) .. body(count - 1), each once, in any order, possibly in parallel, and returns
/// when all are done. A function with a parallel loop takes one as an argument, so its caller
/// decides how the loop runs (render's workers, a host application's pool). An exception of the
/// body may leave the loop after the other calls have ended; functions that take a ParallelFor pass
/// it on. An empty one throws std::bad_function_call.
using ParallelFor =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

/// The default ParallelFor: it makes the calls one after the other on the caller's thread, and
/// stops at the first exception.
inline void serial_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace boule
