#pragma once

#include <string>
#include <vector>

#include "bench/errors/hard_errors.h"

namespace boule::bench {

/// What solvers get wrong by distance and by how closely a sphere is grazed.
struct ErrorMap {
  struct Cell {
    std::string contender;
    int distance;  ///< F / r = 10^(distance / 2)
    int grazing;   ///< half of the rays aimed at r (1 - 2^-grazing) from the centre, half beyond
    test::HardFigures figures;
  };
  static constexpr int nearest = 1, farthest = 14;  ///< of `distance`
  static constexpr int least = 2, most = 24;        ///< of `grazing`, in steps of 2
  std::vector<Cell> cells;
};

/// `rays` pairs a cell, solved by the kernels of `isa`.
ErrorMap map_errors(std::size_t rays, Isa isa);

}  // namespace boule::bench
