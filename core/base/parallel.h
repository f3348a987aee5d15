#pragma once

#include <cstddef>
#include <functional>

namespace boule {

/// Calls body(0) .. body(count - 1), each once, in any order, perhaps at the same time, and returns
/// when all are done. Whoever needs a parallel loop takes one of these; the caller decides what
/// runs it (render's workers, a host application's pool). What the body throws may cross, after the
/// other calls have ended: those who take a ParallelFor pass it on. An empty one throws
/// std::bad_function_call.
using ParallelFor =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

/// The default ParallelFor: one after the other, on the caller's thread, up to the first that
/// throws.
inline void serial_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace boule
