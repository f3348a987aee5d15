#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace boule::bench {

/// Google Benchmark's console table, and after it the ratio of each experiment's rate to those of
/// its contenders: medians over the repetitions, with the range of both.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  /// Compare `experiment` with `contender` where both have run.
  void compare(const std::string& experiment, const std::string& contender);

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  struct Pair {
    std::string experiment, contender;
  };
  std::vector<Pair> pairs_;
  std::map<std::string, std::vector<double>> rates_;  ///< items per second, by name
};

}  // namespace boule::bench
