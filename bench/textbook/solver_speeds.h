#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace boule::bench {

/// Speed of one way to answer the same camera rays, one thread, CPU time.
struct SolverSpeed {
  std::string scene;
  std::string structure;  ///< scan or bvh
  std::string isa;
  std::string solver;  ///< ours: bundle (robust), robust or fast as packets; or a textbook's
  double mrays_per_s;  ///< median of the repetitions
  double least, most;
  std::size_t rays;
  std::size_t differ;  ///< rays that meet another sphere than by solver robust, or none, or one
};

/// Every solver on every ISA that this CPU has, on these scenes (make_scene's names): side x side
/// rays in streams of 1024, by a tree and, up to 2,000 spheres, by a scan. All solvers of one
/// scene and structure take turns, `repetitions` times and one to warm up. Throws
/// std::runtime_error for a scene that there is not.
std::vector<SolverSpeed> measure_solver_speeds(const std::vector<std::string>& scenes,
                                               int repetitions, int side);

}  // namespace boule::bench
