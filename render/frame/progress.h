#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// How far a pass over pixels or rays has come.
struct Progress {
  double share = 0;         ///< of its blocks, 0 .. 1
  std::uint64_t rays = 0;   ///< of all kinds, traced in this pass
  std::size_t running = 0;  ///< blocks that are being worked on, 0: not known
};

}  // namespace boule
