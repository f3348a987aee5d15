#pragma once

#include <array>
#include <string_view>

#include "core/scene/names.h"
#include "simd/abi/isa.h"

namespace boule {

/// The names of solvers in options and statistics.
template <>
inline constexpr std::array<std::string_view, 3> names<Solver>{"fast", "robust", "reference"};

/// The ISA and the threads of a run, and the time of its preparation.
struct RunStatistics {
  double prepare_seconds = 0;
  std::string_view isa{};  ///< the ISA that ran; "scalar" for solver reference
  int width = 1;           ///< number of its float lanes
  Solver solver = Solver::robust;
  unsigned threads = 0;  ///< number of threads in the last pass
};

}  // namespace boule
