#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/peers/contender.h"
#include "bench/peers/double_tree.h"
#include "core/base/parallel.h"

namespace boule::bench {

/// Whether a hit found in float is the truth: both misses, or t off by no more than 1e-4 of itself
/// or 1e-5 |dir| (the scenes are of size 1); another primitive is right if it is met within that
/// too.
bool same_in_float(const BenchScene& scene, const Ray& ray, const Hit& hit, const Hit& truth);

/// Knows the right answers of a workload and counts those that differ.
class Judge {
 public:
  /// Finds the truth of a workload by `tree`, which must hold the scene and outlive the
  /// judge, as must the workload's rays.
  Judge(const Workload& workload, const DoubleTree& tree, const ParallelFor& parallel_for);

  [[nodiscard]] const Answers& truth() const { return truth_; }

  /// Of `samples` rays spread over the workload: how many the truth answers otherwise than the
  /// reference does by brute force.
  [[nodiscard]] std::size_t differ_from_reference(std::size_t samples,
                                                  const ParallelFor& parallel_for) const;

  /// The rays that are answered wrongly. exact: another bit of t, or another id. Otherwise what
  /// same_in_float says.
  [[nodiscard]] std::vector<std::size_t> mismatches(const Answers& answers, bool exact) const;

 private:
  Workload workload_;
  Answers truth_;
};

}  // namespace boule::bench
