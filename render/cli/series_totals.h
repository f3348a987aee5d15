#pragma once

#include <cstddef>
#include <string>

#include "render/cli/stats.h"

namespace boule::cli {

/// What the frames of a series took together.
class SeriesTotals {
 public:
  /// A frame that was rendered; one that was there already.
  void add(const Stats& frame);
  void add_skipped() { ++skipped_; }

  /// "20 frames, 3 of them there already, 12.30 s, 4.2 Mray/s (avx2, 2 threads)": the whole series
  /// took so many seconds, the speed is that of rendering.
  [[nodiscard]] std::string text(double seconds) const;

 private:
  std::size_t rendered_ = 0, skipped_ = 0;
  Stats work_;
};

}  // namespace boule::cli
