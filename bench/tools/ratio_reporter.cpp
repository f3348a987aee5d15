#include "bench/tools/ratio_reporter.h"

#include <algorithm>
#include <cstdio>

#include "bench/tools/median.h"

namespace boule::bench {

void RatioReporter::compare(const std::string& experiment, const std::string& contender) {
  pairs_.push_back({experiment, contender});
}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    const auto rate = run.counters.find("items_per_second");
    if (rate != run.counters.end()) rates_[run.run_name.str()].push_back(rate->second);
  }
  ConsoleReporter::ReportRuns(runs);
}

void RatioReporter::Finalize() {
  std::printf("\n%-34s %-26s %7s %7s   G tests/s: median, min..max of repetitions\n", "experiment",
              "against", "medians", "bests");
  for (const Pair& pair : pairs_) {
    const auto a = rates_.find(pair.experiment), b = rates_.find(pair.contender);
    if (a == rates_.end() || b == rates_.end()) continue;
    const auto [low, high] = std::minmax_element(a->second.begin(), a->second.end());
    const double contender_best = *std::max_element(b->second.begin(), b->second.end());
    std::printf("%-34s %-26s %7.2f %7.2f   %.3f, %.3f..%.3f\n", pair.experiment.c_str(),
                pair.contender.c_str(), median(a->second) / median(b->second),
                *high / contender_best, median(a->second) * 1e-9, *low * 1e-9, *high * 1e-9);
  }
}

}  // namespace boule::bench
