#include <nlohmann/json.hpp>

#include "bench/report/figures.h"

namespace boule::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Provenance& p, const ReportSettings& settings) {
  return {{"cpu", p.cpu},         {"cores", p.cores},        {"compiler", p.compiler},
          {"flags", p.flags},     {"commit", p.commit},      {"date", p.date},
          {"command", p.command}, {"quick", settings.quick}, {"seed", settings.seed}};
}

Json to_json(const SolverSpeed& s) {
  return {{"scene", s.scene},
          {"structure", s.structure},
          {"isa", s.isa},
          {"solver", s.solver},
          {"mrays_per_s", s.mrays_per_s},
          {"min", s.least},
          {"max", s.most},
          {"rays", s.rays},
          {"differ", s.differ}};
}

/// Three columns: decisions and roots, ulp of t, distance from the surface.
Json to_json(test::HardFigures& f) {
  return {{"pairs", f.pairs},
          {"hits", f.hits},
          {"wrong_decisions", f.wrong_decisions},
          {"wrong_roots", f.wrong_roots},
          {"ulp_p50", f.ulp_quantile(0.5)},
          {"ulp_p99", f.ulp_quantile(0.99)},
          {"ulp_max", f.ulp_quantile(1)},
          {"residual_u", f.max_residual}};
}

Json to_json(CaseErrors& c) {
  Json row = {{"case", c.hard_case}, {"isa", c.isa}, {"solver", c.errors.contender}};
  row.update(to_json(c.errors.figures));
  return row;
}

Json to_json(ErrorMap::Cell& cell) {
  Json row = {{"solver", cell.contender}, {"distance", cell.distance}, {"grazing", cell.grazing}};
  row.update(to_json(cell.figures));
  return row;
}

Json to_json(const EpsilonFigure& e) {
  return {
      {"experiment", e.experiment},       {"remedy", e.remedy}, {"x", e.x}, {"points", e.points},
      {"false_shadows", e.false_shadows}, {"leaks", e.leaks}};
}

Json to_json(const Growth& g) {
  return {{"spheres", g.spheres}, {"rays", g.rays}, {"isa", g.isa}, {"form", g.form},
          {"ns_per_ray", g.ns},   {"min", g.least}, {"max", g.most}};
}

Json to_json(const PathError& e) {
  return {{"samples", e.samples}, {"seconds", e.seconds}, {"rms_error", e.error}};
}

Json to_json(const PeerRow& r) {
  return {{"scene", r.scene},
          {"rays", r.rays},
          {"contender", r.contender},
          {"solver", r.solver},
          {"mrays_per_s", r.mrays_per_s},
          {"min", r.least},
          {"max", r.most},
          {"ratio_to_best_embree", r.ratio},
          {"count", r.count},
          {"mismatches", r.mismatches},
          {"one_solve_mrays_per_s", r.one_solve}};
}

Json to_json(const NoiseError& e) {
  return {{"asked", e.asked},        {"mean_samples", e.mean_samples},
          {"seconds", e.seconds},    {"mrays", e.mrays},
          {"rms_error", e.rms},      {"within_95", e.within_95},
          {"within_99", e.within_99}};
}

Json to_json(ScenePathErrors& s);
Json to_json(SceneNoiseErrors& s);

template <class T>
Json list(std::vector<T>& values) {
  Json all = Json::array();
  for (T& value : values) all.push_back(to_json(value));
  return all;
}

Json to_json(ScenePathErrors& s) {
  return {
      {"scene", s.scene}, {"sequence", list(s.errors.sequence)}, {"random", list(s.errors.random)}};
}

Json to_json(SceneNoiseErrors& s) {
  return {{"scene", s.scene},
          {"uniform", list(s.errors.uniform)},
          {"random", list(s.errors.random)},
          {"to_order", list(s.errors.to_order)}};
}

}  // namespace

std::string to_json(Figures& figures) {
  Json report = {{"provenance", to_json(figures.provenance, figures.settings)},
                 {"speeds", list(figures.speeds)},
                 {"hard_cases", list(figures.cases)},
                 {"error_map", {{"isa", figures.widest}, {"cells", list(figures.map.cells)}}},
                 {"epsilons", list(figures.epsilons)},
                 {"growth", list(figures.growth)},
                 {"path_errors", list(figures.paths)},
                 {"noise_errors", list(figures.noise)},
                 {"embree", nullptr}};
  if (figures.peers)
    report["embree"] = {{"version", figures.peers->embree}, {"rows", list(figures.peers->rows)}};
  return report.dump(2) + "\n";
}

}  // namespace boule::bench
