#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/peers/frames/frame_pictures.h"
#include "core/base/error.h"

namespace boule::bench {

/// Whole frames by whole programs: which, and how often.
struct FrameSettings {
  std::vector<std::string> scenes = {"flake4", "flake5"};
  std::vector<std::string> isas;  ///< of Boule's kernels
  int repetitions = 5;
  int side = 1024;       ///< pixels
  std::string pictures;  ///< folder to keep the pictures in; empty: they are removed
};

/// Seconds over the repetitions.
struct Spread {
  double median = 0, min = 0, max = 0;
};

/// One program's frame. CPU time of one thread, less what the same frame of 8x8 pixels takes.
struct FrameRow {
  std::string scene;
  std::string program;  ///< "boule-avx2", "tachyon-plane"
  std::string missing;  ///< name of the program that is not installed; then there are no figures
  Spread cpu;
  double start_up = 0;  ///< median of the CPU time for 8x8 pixels: start, reading, preparing
  double ratio = 0;     ///< to the best of Boule's, of medians
  /// Of its picture from the first of Boule's; none for that one itself.
  std::optional<Difference> difference;
  std::optional<Tolerance> tolerance;
  [[nodiscard]] bool alike() const { return !difference || within(*difference, *tolerance); }
};

/// Boule on two threads: wall-clock time, minus the time of a frame of 8x8 pixels.
struct ScalingRow {
  std::string scene, program;
  Spread one, two;
  double speedup = 0;  ///< of medians
};

struct FrameResults {
  std::vector<FrameRow> rows;
  std::vector<ScalingRow> scaling;
};

/// Renders every scene by every program, repetitions interleaved, and compares the pictures with
/// Boule's. Calls `report` after each scene.
Result<FrameResults> compare_frames(const FrameSettings& settings,
                                    const std::function<void(const FrameResults&)>& report);

}  // namespace boule::bench
