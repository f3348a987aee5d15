#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/peers/frames/frame_pictures.h"
#include "bench/scenes/bench_scenes.h"
#include "core/base/error.h"

namespace boule::bench {

/// The most mirrors that a ray meets; beyond these a mirror shows black.
inline constexpr int frame_bounces = 1;

/// POV-Ray's pictures differ from Boule's at a few edges only. Tachyon's samples cannot be shifted
/// by half a pixel everywhere at once, so its edges differ, and so do its last mirror images.
inline constexpr Tolerance pov_tolerance = {0.005, 0.002};
inline constexpr Tolerance tachyon_tolerance = {0.02, 0.05};

/// A program that makes a picture of one scene.
struct FrameProgram {
  std::string name;    ///< "boule-avx2", "tachyon-plane"
  std::string binary;  ///< "tachyon", by PATH
  std::string path;    ///< of the binary; empty: not installed
  bool ours = false;
  std::string extension = ".ppm";  ///< of its pictures, which are not packed
  Curve curve = Curve::linear;     ///< of its pictures
  Tolerance tolerance{};           ///< of its pictures towards Boule's
  Color habit{};                   ///< see compare_pictures
  /// The command for a picture of `side` pixels a side on so many threads.
  std::function<std::vector<std::string>(int side, unsigned threads, const std::string& picture)>
      command;
};

/// Boule, once per ISA, then all peers, installed or not. Writes the scene's files for pictures of
/// `side` pixels into `folder`.
Result<std::vector<FrameProgram>> make_frame_programs(const BenchScene& flake,
                                                      const std::vector<std::string>& isas,
                                                      int side,
                                                      const std::filesystem::path& folder);

}  // namespace boule::bench
