#pragma once

#include <ctime>

namespace boule::bench {

/// Processor seconds of this thread so far. Other load on the machine changes them little.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace boule::bench
