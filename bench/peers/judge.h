#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/peers/contender.h"
#include "bench/peers/double_tree.h"
#include "core/base/parallel.h"

namespace boule::bench {

/// What is right, and who differs from it.
class Judge {
 public:
  /// Finds the truth of a workload by `tree`, which must hold the scene's spheres and outlive the
  /// judge, as must the workload's rays.
  Judge(const Workload& workload, const DoubleTree& tree, const ParallelFor& parallel_for);

  [[nodiscard]] const Answers& truth() const { return truth_; }

  /// Of `samples` rays spread over the workload: how many the truth answers otherwise than the
  /// reference does by brute force.
  [[nodiscard]] std::size_t differ_from_reference(std::size_t samples,
                                                  const ParallelFor& parallel_for) const;

  /// The rays that are answered wrongly. exact: another bit of t, or another id. Otherwise a hit
  /// for a miss, a miss for a hit, or t that is off by more than `tolerance`; another id only where
  /// that sphere is not met within tolerance of the truth.
  [[nodiscard]] std::vector<std::size_t> mismatches(const Answers& answers, bool exact) const;

  /// Whether two distances along a ray are one to float: the error times |dir| within 1e-4 of the
  /// distance, or within 1e-5, in scenes of size 1.
  [[nodiscard]] static bool same_distance(const Ray& ray, double t, double truth);

 private:
  [[nodiscard]] bool same_in_float(const Ray& ray, const Hit& hit, const Hit& truth) const;

  Workload workload_;
  Answers truth_;
};

}  // namespace boule::bench
