#include "bench/report/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace boule::bench {
namespace {

struct Named {
  const char* key;
  const char* name;
  int color;
};
constexpr std::array solvers = {
    Named{"bundle", "robust, bundles (ours)", 8},
    Named{"robust", "robust, packets (ours)", 9},
    Named{"fast", "fast, packets (ours)", 0},
    Named{"half_b", "half-b", 1},
    Named{"textbook", "textbook", 4},
    Named{"stable_q", "stable q", 3},
    Named{"kahan", "Kahan", 7},
    Named{"closest_approach", "closest approach", 5},
    Named{"half_b_double", "half-b, double", 2},
    Named{"closest_approach_double", "closest approach, double", 6},
};
constexpr std::array isas = {"scalar", "sse42", "avx2", "avx512", "neon"};
constexpr std::array forms = {Named{"bundle", "bundles", 8}, Named{"packet", "packets", 0},
                              Named{"single", "single rays", 1}};

constexpr std::array secondary_kinds = {
    Named{"shadow", "shadow rays to a point", 8}, Named{"light", "shadow rays to a ball", 0},
    Named{"mirror", "mirrored", 1}, Named{"diffuse", "diffuse bounces", 4}};

const Named* find(const std::string& solver) {
  const auto* const found =
      std::find_if(solvers.begin(), solvers.end(), [&](const Named& n) { return solver == n.key; });
  return found == solvers.end() ? nullptr : found;
}

int shape_of(const std::string& isa) {
  const auto* const found =
      std::find_if(isas.begin(), isas.end(), [&](const char* name) { return isa == name; });
  return static_cast<int>(found - isas.begin()) % 5;
}

/// The ISAs of the rows, in the order in which they first appear.
template <class Rows>
void add_isas(const Rows& rows, std::vector<LegendEntry>& legend) {
  for (const char* isa : isas) {
    const bool there =
        std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.isa == isa; });
    if (there) legend.push_back({isa, {6, shape_of(isa)}});
  }
}

const char* title_of(const std::string& experiment) {
  if (experiment == "scale") return "Wrong shadows over the scene's scale";
  if (experiment == "distance") return "Wrong shadows over the camera's distance";
  return "Wrong shadows over the radius of the ground";
}
const char* axis_of(const std::string& experiment) {
  if (experiment == "scale") return "size of a ball, in units";
  if (experiment == "distance") return "distance of the camera, in radii of the ball";
  return "radius of the ground sphere, in radii of the balls on it";
}

/// A line for each of `lines` and each ISA; key_of(growth) tells to which it belongs.
template <class Lines, class KeyOf>
void add_growth(const Figures& figures, const Lines& lines, const KeyOf& key_of, Chart& chart) {
  for (const Named& line : lines) {
    for (const char* isa : isas) {
      Series series{fmt::format("{}, {}", line.name, isa), {line.color, shape_of(isa)}, true, {}};
      for (const Growth& growth : figures.growth) {
        if (key_of(growth) != line.key || growth.isa != isa) continue;
        series.points.push_back(
            {static_cast<double>(growth.spheres), growth.ns,
             fmt::format("{}, {}, {} spheres: {:.1f} ns ({:.1f} to {:.1f})", line.name, isa,
                         growth.spheres, growth.ns, growth.least, growth.most)});
      }
      if (!series.points.empty()) chart.series.push_back(series);
    }
    chart.legend.push_back({line.name, {line.color, 0}});
  }
  add_isas(figures.growth, chart.legend);
}

Series path_series(const char* name, Look look, const std::vector<PathError>& errors) {
  Series series{name, look, true, {}};
  for (const PathError& e : errors) {
    series.points.push_back({e.seconds, e.error,
                             fmt::format("{}, {} samples a pixel: error {:.3g} after {:.3g} s",
                                         name, e.samples, e.error, e.seconds)});
  }
  return series;
}

Series noise_series(const char* name, Look look, const std::vector<NoiseError>& errors) {
  Series series{name, look, true, {}};
  for (const NoiseError& e : errors) {
    series.points.push_back(
        {e.seconds, e.within_99,
         fmt::format("{}, {:.3g} samples a pixel: 99 % within {:.3g} after {:.3g} s", name,
                     e.mean_samples, e.within_99, e.seconds)});
  }
  return series;
}

/// Keeps each label at its fastest point only.
void label_fastest(std::vector<Series>& series) {
  for (Series& one : series) {
    ChartPoint& point = one.points.front();
    const auto outruns = [&](const Series& other) {
      const ChartPoint& rival = other.points.front();
      return rival.label == point.label && rival.y > point.y;
    };
    if (std::any_of(series.begin(), series.end(), outruns)) point.label.clear();
  }
}

}  // namespace

std::string solver_name(const std::string& solver) {
  const Named* const found = find(solver);
  return found == nullptr ? solver : found->name;
}
Look solver_look(const std::string& solver, const std::string& isa) {
  const Named* const found = find(solver);
  return {found == nullptr ? 6 : found->color, shape_of(isa)};
}

double ErrorSum::per_million() const {
  return pairs == 0 ? 0 : 1e6 * static_cast<double>(wrong) / static_cast<double>(pairs);
}

ErrorSums sum_errors(const std::vector<CaseErrors>& cases) {
  ErrorSums sums;
  for (const CaseErrors& row : cases) {
    ErrorSum& sum = sums[{row.isa, row.errors.contender}];
    sum.pairs += row.errors.figures.pairs;
    sum.wrong += row.errors.figures.wrong_decisions;
  }
  return sums;
}

Chart speed_chart(const Figures& figures, const std::string& scene, const std::string& structure) {
  Chart chart{fmt::format("Speed against error, {}, {}", scene,
                          structure == "bvh" ? "through the tree" : "every sphere tested"),
              {"wrong hits or misses in a million hard pairs", true},
              {"million rays per second, one thread", true},
              {},
              {}};
  const ErrorSums sums = sum_errors(figures.cases);
  std::vector<SolverSpeed> shown;
  for (const SolverSpeed& speed : figures.speeds) {
    const bool bundle = speed.solver == "bundle";  // whose hits are robust's, bit for bit
    const auto sum = sums.find({speed.isa, bundle ? "robust" : speed.solver});
    if (speed.scene != scene || speed.structure != structure || sum == sums.end()) continue;
    shown.push_back(speed);
    const double wrong = sum->second.per_million();
    const std::string tip = fmt::format(
        "{}, {}: {:.3g} Mray/s ({:.3g} to {:.3g}), {:.0f} wrong in a million",
        solver_name(speed.solver), speed.isa, speed.mrays_per_s, speed.least, speed.most, wrong);
    chart.series.push_back({tip,
                            solver_look(speed.solver, speed.isa),
                            false,
                            {{wrong, speed.mrays_per_s, tip, solver_name(speed.solver)}}});
  }
  label_fastest(chart.series);
  for (const Named& solver : solvers) chart.legend.push_back({solver.name, {solver.color, 0}});
  add_isas(shown, chart.legend);
  return chart;
}

HeatMap error_chart(Figures& figures, const std::string& solver) {
  HeatMap map{solver_name(solver) + ": wrong hits, misses",
              "distance of the sphere in radii, 10^x",
              "k: aimed at r (1 +/- 2^-k)",
              {},
              {},
              {},
              {}};
  for (int distance = ErrorMap::nearest; distance <= ErrorMap::farthest; ++distance)
    map.columns.push_back(fmt::format("{:.1f}", distance / 2.0));
  for (int grazing = ErrorMap::least; grazing <= ErrorMap::most; grazing += 2)
    map.rows.push_back(std::to_string(grazing));
  for (ErrorMap::Cell& cell : figures.map.cells) {
    if (cell.contender != solver) continue;
    test::HardFigures& f = cell.figures;
    const double wrong = static_cast<double>(f.wrong_decisions) / static_cast<double>(f.pairs);
    map.values.push_back(wrong);
    map.tips.push_back(fmt::format(
        "distance 10^{:.1f} radii, 2^-{}: {} of {} wrong; t off by {:.3g} ulp (p99)",
        cell.distance / 2.0, cell.grazing, f.wrong_decisions, f.pairs, f.ulp_quantile(0.99)));
  }
  return map;
}

Chart epsilon_chart(const Figures& figures, const std::string& experiment) {
  Chart chart{title_of(experiment),
              {axis_of(experiment), true},
              {"points judged wrongly, %", false},
              {},
              {}};
  const std::vector<std::string> remedies = epsilon_remedies();
  for (std::size_t i = 0; i < remedies.size(); ++i) {
    const bool ours = remedies[i] == "ours";
    const Look look{ours ? 8 : static_cast<int>(i % 8), static_cast<int>(i % 5)};
    Series series{remedies[i], look, true, {}};
    for (const EpsilonFigure& figure : figures.epsilons) {
      if (figure.experiment != experiment || figure.remedy != remedies[i]) continue;
      const double points = static_cast<double>(std::max<std::size_t>(figure.points, 1));
      const double share = 100 * static_cast<double>(figure.false_shadows + figure.leaks) / points;
      series.points.push_back(
          {figure.x, share,
           fmt::format("{}, {:.3g}: {} false shadows and {} leaks at {} points", figure.remedy,
                       figure.x, figure.false_shadows, figure.leaks, figure.points)});
    }
    chart.legend.push_back({remedies[i], look});
    chart.series.push_back(series);
  }
  return chart;
}

Chart growth_chart(const Figures& figures) {
  Chart chart{"Time of a camera ray among n random spheres",
              {"spheres", true},
              {"nanoseconds a ray, one thread", true},
              {},
              {}};
  const auto form_of = [](const Growth& growth) {
    return growth.rays == "primary" ? growth.form : std::string();
  };
  add_growth(figures, forms, form_of, chart);
  return chart;
}

Chart secondary_chart(const Figures& figures) {
  Chart chart{"Time of a secondary ray among n random spheres",
              {"spheres", true},
              {"nanoseconds a ray, one thread", true},
              {},
              {}};
  add_growth(
      figures, secondary_kinds, [](const Growth& growth) { return growth.rays; }, chart);
  return chart;
}

Chart path_error_chart(const ScenePathErrors& scene) {
  constexpr Look ours{8, 0}, theirs{1, 1};
  constexpr const char* our_name = "scrambled Sobol (ours)";
  constexpr const char* their_name = "plain random numbers";
  return {"Error of path tracing over time, " + scene.scene,
          {"seconds, one thread", true},
          {"RMS error of the radiance", true},
          {path_series(our_name, ours, scene.errors.sequence),
           path_series(their_name, theirs, scene.errors.random)},
          {{our_name, ours}, {their_name, theirs}}};
}

Chart noise_chart(const SceneNoiseErrors& scene) {
  constexpr Look to_order{8, 0}, uniform{0, 2}, random{1, 1};
  return {"Error of pictures over time, " + scene.scene,
          {"seconds, one thread", true},
          {"error of 99 % of the pixels, displayed", true},
          {noise_series("noise to order", to_order, scene.errors.to_order),
           noise_series("as many samples everywhere", uniform, scene.errors.uniform),
           noise_series("the same, plain random numbers", random, scene.errors.random)},
          {{"noise to order", to_order},
           {"as many samples everywhere", uniform},
           {"the same, plain random numbers", random}}};
}

}  // namespace boule::bench
