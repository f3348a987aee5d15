#pragma once

#include <string_view>

#include "simd/abi/isa.h"

namespace boule {

/// What ran, and how long it took to prepare.
struct RunStatistics {
  double prepare_seconds = 0;
  std::string_view isa;  ///< that really ran: "scalar" for solver reference
  int width = 1;         ///< float lanes of it
  Solver solver = Solver::robust;
  unsigned threads = 0;  ///< that the last pass really had
};

}  // namespace boule
