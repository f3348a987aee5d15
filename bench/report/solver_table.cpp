#include "bench/report/solver_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/report/charts.h"
#include "bench/report/page_parts.h"

namespace boule::bench {
namespace {

/// A solver's errors over all hard cases.
struct AllErrors {
  std::size_t pairs = 0, wrong = 0;
  std::vector<double> ulps;       ///< of each case the 99th percentile of its hits
  std::vector<double> residuals;  ///< of each case the greatest

  void add(test::HardFigures& figures) {
    pairs += figures.pairs;
    wrong += figures.wrong_decisions + figures.wrong_roots;
    if (figures.wrong_decisions >= figures.hits) return;  // with none right there is no t to judge
    ulps.push_back(figures.ulp_quantile(0.99));
    residuals.push_back(figures.max_residual);
  }
};

/// "0.5 / 0.8": the median and the greatest.
std::string middle_and_most(std::vector<double>& values) {
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  return fmt::format("{:.2g} / {:.2g}", values[values.size() / 2], values.back());
}

}  // namespace

std::string solver_table(Figures& figures) {
  std::map<std::string, AllErrors> errors;
  for (CaseErrors& row : figures.cases) {
    if (row.isa == figures.widest) errors[row.errors.contender].add(row.errors.figures);
  }
  const std::string scene = main_scene(figures);
  Table table({"solver", scene + ": Mray/s", "wrong in a million hard pairs",
               "error of t, ulp: median / worst case", "distance from the surface: likewise"});
  for (const SolverSpeed& speed : figures.speeds) {
    if (speed.scene != scene || speed.structure != "bvh" || speed.isa != figures.widest) continue;
    AllErrors& all = errors[speed.solver == "bundle" ? "robust" : speed.solver];
    if (all.pairs == 0) continue;
    const double share = static_cast<double>(all.wrong) / static_cast<double>(all.pairs);
    table.add({solver_name(speed.solver), fmt::format("{:.3g}", speed.mrays_per_s),
               fmt::format("{:.0f}", 1e6 * share), middle_and_most(all.ulps),
               middle_and_most(all.residuals)});
  }
  return table.html();
}

}  // namespace boule::bench
