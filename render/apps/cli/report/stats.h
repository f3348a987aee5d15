#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/frame/measured_picture.h"
#include "render/integrators/integrator.h"
#include "render/renderer/run_statistics.h"

namespace boule::cli {

/// The statistics that only a picture has.
struct PictureStats {
  Size size{};  ///< pixels: of the crop where there is one
  int spp = 1;
  RayCounts rays;
  SampleFaults faults;
  std::optional<NoiseReached> noise{};  ///< none: it was not measured
  float noise_target = 0, aa = 0;       ///< one of them is asked for, if it was measured
};

/// The statistics of a render or a trace. Times are wall-clock seconds.
struct Stats : RunStatistics {
  double load_seconds = 0;
  double work_seconds = 0;  ///< of rendering or tracing
  double write_seconds = 0;
  double total_seconds = 0;
  std::uint64_t rays = 0;               ///< of all kinds
  std::uint64_t points = 0;             ///< whose surroundings were searched
  std::optional<PictureStats> picture;  ///< none: it was a trace
};

/// Millions of rays, or of points, per second of work, 0 where it took no time.
double mrays_per_s(const Stats& stats);
double mpoints_per_s(const Stats& stats);

/// "16 spp", or "143.2 spp on average, noise 0.019".
std::string samples_text(const PictureStats& picture);

/// A note for each kind of sample that the picture does not show as it was.
std::vector<std::string> fault_notes(const SampleFaults& faults);

/// Writes text to standard error, or JSON (schema 1) to standard output or to a file, which appears
/// only when it is complete.
Status write_stats(const Stats& stats, const StatsTarget& target);

}  // namespace boule::cli
