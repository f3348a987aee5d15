// The README's tables of figures: written by the run that measured them, like the page.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/report/charts.h"
#include "bench/report/figures.h"

namespace boule::bench {
namespace {

constexpr const char* begin_mark = "<!-- report: begin -->\n";
constexpr const char* end_mark = "<!-- report: end -->\n";

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

std::string solver_rows(Figures& figures) {
  std::map<std::string, AllErrors> errors;
  for (CaseErrors& row : figures.cases) {
    if (row.isa == figures.widest) errors[row.errors.contender].add(row.errors.figures);
  }
  const std::string scene = main_scene(figures);
  std::string rows = fmt::format(
      "| solver | {}: Mray/s | wrong in a million hard pairs | error of t, ulp | distance from the "
      "surface, u max(F, r) |\n|---|---:|---:|---:|---:|\n",
      scene);
  for (const SolverSpeed& speed : figures.speeds) {
    if (speed.scene != scene || speed.structure != "bvh" || speed.isa != figures.widest) continue;
    AllErrors& all = errors[speed.solver == "bundle" ? "robust" : speed.solver];
    if (all.pairs == 0) continue;
    rows += fmt::format("| {} | {:.3g} | {:.0f} | {} | {} |\n", solver_name(speed.solver),
                        speed.mrays_per_s,
                        1e6 * static_cast<double>(all.wrong) / static_cast<double>(all.pairs),
                        middle_and_most(all.ulps), middle_and_most(all.residuals));
  }
  return rows;
}

std::string peer_lines(const PeerRows& peers) {
  std::string lines =
      "| rays | best of Embree, Mray/s | wrong | Boule, Mray/s | wrong | ratio |\n"
      "|---|---:|---:|---:|---:|---:|\n";
  const PeerRow* best = nullptr;
  for (const PeerRow& row : peers.rows) {
    if (best != nullptr && (best->scene != row.scene || best->rays != row.rays)) best = nullptr;
    const bool embree = row.contender.starts_with("embree");
    if (embree && (best == nullptr || best->mrays_per_s < row.mrays_per_s)) best = &row;
    if (best == nullptr || !(row.contender == "boule-avx2" || row.contender == "boule-avx512"))
      continue;
    lines += fmt::format("| {}, {}, {} | {:.3g} | {} | {:.3g} | {} | {:.2f} |\n", row.scene,
                         row.rays, row.contender.substr(6), best->mrays_per_s, best->mismatches,
                         row.mrays_per_s, row.mismatches, row.ratio);
  }
  return lines;
}

std::string tables(Figures& figures) {
  const Provenance& p = figures.provenance;
  const std::size_t pairs =
      figures.cases.empty() ? 0 : sum_errors(figures.cases).begin()->second.pairs;
  std::string text = fmt::format(
      "Measured on {}, {}, commit {}{}, by `{}`; one thread, {}, {} hard pairs for each solver. "
      "Errors of t are the 99th percentiles, distances the greatest, of the median and of the "
      "worst "
      "hard case; u = 2^-24, F the distance of the centre.\n\n",
      p.cpu, p.compiler, p.commit, p.date.empty() ? "" : ", " + p.date, p.command, figures.widest,
      pairs);
  text += solver_rows(figures);
  if (!figures.peers) return text;
  const std::size_t rays = figures.peers->rows.empty() ? 0 : figures.peers->rows.front().count;
  return text +
         fmt::format(
             "\nAgainst Embree {}, the best of its modes, on the same rays ({} of a camera "
             "for each scene); wrong: another hit than an independent tree in double "
             "finds.\n\n",
             figures.peers->embree, rays) +
         peer_lines(*figures.peers);
}

}  // namespace

std::optional<std::string> with_tables(const std::string& readme, Figures& figures) {
  const std::size_t begin = readme.find(begin_mark), end = readme.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return std::nullopt;
  return readme.substr(0, begin) + begin_mark + tables(figures) + readme.substr(end);
}

}  // namespace boule::bench
