#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace boule::bench {

/// One contender on one workload, as the referee saw it.
struct PeerRow {
  std::string scene, rays, contender, solver;
  double mrays_per_s, least, most;
  double ratio;  ///< to the best Embree mode
  std::size_t count, mismatches;
  double one_solve;  ///< Mray/s of one_solve_rate() (bench/peers/one_solve.h); 0: not measured
};

struct PeerRows {
  std::string embree;  ///< version
  std::vector<PeerRow> rows;
};

/// Boule against Embree's best modes on the same rays, in one run; nothing where this build has no
/// Embree. quick: two small scenes.
std::optional<PeerRows> measure_peers(bool quick);

}  // namespace boule::bench
