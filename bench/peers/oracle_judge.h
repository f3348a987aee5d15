#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "bench/peers/contender.h"
#include "bench/peers/double_tree.h"

namespace boule::bench {

/// The number of answers judged, of those that differ from the truth, and how many are wrong.
struct OracleVerdict {
  std::size_t judged = 0, wrong = 0;
};

/// Decides between a contender and the truth by the tests' oracle of 1400 bits. It judges the ray
/// that the workload holds, its origin in double: a contender that rounds it to float answers for
/// that error as well.
class OracleJudge {
 public:
  /// `tree` holds the scene; all must outlive the judge.
  OracleJudge(const Workload& workload, const DoubleTree& tree)
      : workload_(workload), tree_(tree) {}

  /// Judges the answers to these rays, at most 1000 of them, spread evenly. Nothing where the build
  /// has no MPFR.
  std::optional<OracleVerdict> judge(const Answers& answers, const std::vector<std::size_t>& rays);

 private:
  const Hit& nearest(std::size_t ray);

  Workload workload_;
  const DoubleTree& tree_;
  std::map<std::size_t, Hit> nearest_;  ///< contenders err on the same rays
};

}  // namespace boule::bench
