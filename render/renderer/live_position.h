#pragma once

#include <cstddef>
#include <limits>

#include "render/frame/stopwatch.h"

namespace boule {

/// The state of a rendering in steps. The finished picture is the same from any start.
struct LivePosition {
  std::size_t pass = 0;   ///< of LivePasses, the current one
  std::size_t block = 0;  ///< number of its blocks that are done
  /// The fraction of the first round that comes last, 0 <= r < 1: of the blocks in orders rows and
  /// tiles, of the passes in order frameless. Ignored in order progressive, which begins with its
  /// coarsest pass.
  double rotated_by = 0;
};

/// The amount of work in a step: at least a block, and at most about this.
struct StepLimit {
  double seconds = 0.03;
  double pixels = std::numeric_limits<double>::infinity();
};

/// Blocks of a pass, up to `end`, that must begin before a time.
struct BlockRange {
  std::size_t end;
  const Stopwatch& watch;
  double seconds;  ///< the time by which they begin
};

}  // namespace boule
