#pragma once

#include <array>
#include <string_view>

#include "core/scene/names.h"
#include "simd/abi/isa.h"

namespace boule {

/// As options and statistics name them.
template <>
inline constexpr std::array<std::string_view, 3> names<Solver>{"fast", "robust", "reference"};

/// What ran, and how long its preparation took.
struct RunStatistics {
  double prepare_seconds = 0;
  std::string_view isa{};  ///< that ran; "scalar" for solver reference
  int width = 1;           ///< number of its float lanes
  Solver solver = Solver::robust;
  unsigned threads = 0;  ///< that the last pass ran on
};

}  // namespace boule
