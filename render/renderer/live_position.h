#pragma once

#include <cstddef>
#include <limits>

#include "render/frame/stopwatch.h"

namespace boule {

/// Where a rendering in steps stands. The finished picture does not depend on where it began.
struct LivePosition {
  std::size_t pass = 0;   ///< of LivePasses, the one that goes on
  std::size_t block = 0;  ///< how many of its blocks are done
  /// What share of the first round comes last, 0 <= r < 1: of the blocks in orders rows and tiles,
  /// of the passes in order frameless. Nothing in order progressive, which begins with its coarsest
  /// pass.
  double rotated_by = 0;
};

/// How much a step does: at least a block, and at most about this.
struct StepLimit {
  double seconds = 0.03;
  double pixels = std::numeric_limits<double>::infinity();
};

/// Blocks of a pass, up to `end`, that are to be begun before a time.
struct BlockRange {
  std::size_t end;
  const Stopwatch& watch;
  double seconds;  ///< that it may show
};

}  // namespace boule
