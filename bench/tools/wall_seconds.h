#pragma once

#include <algorithm>
#include <thread>
#include <vector>

#include "render/frame/stopwatch.h"

namespace boule::bench {

/// What `work` takes by the clock on the wall.
double wall_seconds(const auto& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

/// 1, 2, 4 ... and the number of threads that this machine runs at once.
inline std::vector<unsigned> thread_counts() {
  const unsigned most = std::max(std::thread::hardware_concurrency(), 1U);
  std::vector<unsigned> counts;
  for (unsigned threads = 1; threads < most; threads *= 2) counts.push_back(threads);
  counts.push_back(most);
  return counts;
}

}  // namespace boule::bench
