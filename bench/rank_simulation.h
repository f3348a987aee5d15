#pragma once

#include <cstdint>
#include <vector>

namespace boule::bench {

/// What letters between ranks take.
struct Network {
  double latency = 20e-6;         ///< seconds from rank to rank
  double bytes_per_second = 1e9;  ///< of the leader's link, in or out, one letter after the other
  double taken_per_second = 1e9;  ///< bytes that the leader puts into its film
  double look_interval = 2e-3;    ///< seconds between two looks for letters
};

/// A picture that ranks of one thread each render together.
struct SimulatedRun {
  std::vector<double> costs;  ///< seconds of each block, in the order in which they are dealt
  double block_bytes = 0;     ///< of a block's part
  int ranks = 1;
  Network network;
};

/// How it went.
struct SimulatedEnd {
  double seconds = 0;     ///< until the leader has the last block
  double efficiency = 0;  ///< the blocks' seconds, over those of all ranks
  std::uint64_t letters = 0;
};

/// Plays a run with the program's own BlockDealer, event by event.
SimulatedEnd simulate(const SimulatedRun& run);

}  // namespace boule::bench
