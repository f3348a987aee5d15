#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/peers/oracle_judge.h"
#include "bench/scenes/ray_kinds.h"
#include "core/base/error.h"

namespace boule::bench {

/// What to compare.
struct RefereeSettings {
  std::vector<std::string> scenes;
  std::vector<RayKind> kinds;
  std::vector<std::string> isas;         ///< of Boule's kernels
  std::vector<std::string> embree_isas;  ///< avx2 and avx512, or one of them
  int repetitions = 7;
  double patience = 15;  ///< seconds on the wall after which a workload gets 3 repetitions only
  unsigned threads = 1;  ///< 1: rates by the thread's CPU time; more: by the clock on the wall
  int side = 1024;       ///< pixels
};

/// One contender's figures on one workload.
struct Row {
  std::string scene, rays, contender, isa;
  std::size_t width = 0;  ///< rays per call
  std::string solver;
  double median = 0, min = 0, max = 0;  ///< Mray/s over the repetitions
  int repetitions = 0;
  double ratio_to_best_embree = 0;  ///< of medians
  double ratio_within_isa = 0;      ///< to the best Embree of the same isa; 0: there was none
  std::size_t mismatches = 0;
  std::optional<OracleVerdict> oracle;  ///< on the mismatches; none without MPFR
  bool exact = false;                   ///< a mismatch is a fault
};

/// One workload, and how well its truth agrees with brute force.
struct Check {
  std::string scene, rays;
  std::size_t count = 0;             ///< rays
  std::size_t sampled = 0;           ///< rays that the reference answered as well
  std::size_t truth_mismatches = 0;  ///< of these
  double one_solve = 0;  ///< Mray/s of one_solve_rate(), with the widest ISA; 0: not measured
};

struct Results {
  std::vector<Check> checks;
  std::vector<Row> rows;
};

/// Rays that the reference answers of every workload: fewer where there are millions of primitives.
inline constexpr std::size_t reference_samples = 4096;
inline constexpr std::size_t most_reference_tests = 2'000'000'000;

/// The instruction sets that Embree has on this machine, avx2 first.
std::vector<std::string> embree_isas();

/// Runs all contenders on all workloads, repetitions interleaved, and judges their answers. A
/// contender that is below a quarter of the best rate of its side after one repetition, or below
/// half of it after two, gets no more. Calls `report` after each workload with its check and rows.
Result<Results> compare(const RefereeSettings& settings,
                        const std::function<void(const Check&, const std::vector<Row>&)>& report);

}  // namespace boule::bench
