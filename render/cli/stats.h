#pragma once

#include <chrono>
#include <string>

#include "core/base/error.h"
#include "render/cli/options.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// What a render took, beside what the Renderer counts. Times are wall-clock seconds.
struct Stats {
  RenderStatistics rendering;
  Size size{};  ///< pixels of the picture: of the crop where there is one
  int spp = 1;
  double load_seconds = 0;
  double write_seconds = 0;
  double total_seconds = 0;
};

/// Seconds since its construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Millions of rays per second of rendering, 0 where it took no time.
double mrays_per_s(const RenderStatistics& statistics);

/// Text on standard error, or JSON (schema 1) on standard output or in a file that appears whole.
Status write_stats(const Stats& stats, const StatsTarget& target);

}  // namespace boule::cli
