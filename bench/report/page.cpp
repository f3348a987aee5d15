// The page: all figures as charts and tables, in one file that loads nothing else.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bench/report/charts.h"
#include "bench/report/data_uri.h"
#include "bench/report/page_parts.h"
#include "bench/report/solver_table.h"

namespace boule::bench {
namespace {

std::string figure(const Chart& chart) {
  return "<figure>" + draw(chart) + draw_legend(chart) + "</figure>\n";
}

std::string paragraph(const std::string& html) { return "<p>" + html + "</p>\n"; }

/// Scenes in the order of their rows, of one structure.
std::vector<std::string> scenes_of(const Figures& figures, const std::string& structure) {
  std::vector<std::string> scenes;
  for (const SolverSpeed& speed : figures.speeds) {
    const bool seen = std::find(scenes.begin(), scenes.end(), speed.scene) != scenes.end();
    if (speed.structure == structure && !seen) scenes.push_back(speed.scene);
  }
  return scenes;
}

const SolverSpeed* find_speed(const Figures& figures, const SolverSpeed& like,
                              const std::string& solver) {
  for (const SolverSpeed& speed : figures.speeds) {
    if (speed.scene == like.scene && speed.structure == like.structure && speed.isa == like.isa &&
        speed.solver == solver)
      return &speed;
  }
  return nullptr;
}

std::string ratio_cell(const SolverSpeed& ours, const SolverSpeed* other) {
  if (other == nullptr || other->mrays_per_s == 0) return "-";
  return fmt::format("{:.2f}", ours.mrays_per_s / other->mrays_per_s);
}

/// The cost of exactness: the speed of robust as a ratio to that of float.
std::string cost_table(const Figures& figures) {
  Table table({"scene", "by", "ISA", "bundles, Mray/s", "packets, Mray/s", "packets to fast",
               "packets to half-b", "bundles to half-b", "other hits: fast", "half-b"});
  double least = 1e9;
  std::string where;
  for (const SolverSpeed& speed : figures.speeds) {
    if (speed.solver != "robust") continue;
    const SolverSpeed* const fast = find_speed(figures, speed, "fast");
    const SolverSpeed* const half_b = find_speed(figures, speed, "half_b");
    const SolverSpeed* const bundle = find_speed(figures, speed, "bundle");
    if (fast == nullptr || half_b == nullptr || bundle == nullptr) continue;
    table.add({speed.scene, speed.structure == "bvh" ? "tree" : "scan", speed.isa,
               fmt::format("{:.3g}", bundle->mrays_per_s), fmt::format("{:.3g}", speed.mrays_per_s),
               ratio_cell(speed, fast), ratio_cell(speed, half_b), ratio_cell(*bundle, half_b),
               std::to_string(fast->differ), std::to_string(half_b->differ)});
    const double ratio = speed.mrays_per_s / fast->mrays_per_s;
    if (ratio >= least) continue;
    least = ratio;
    where = fmt::format("{}, {}, {}", speed.scene, speed.structure == "bvh" ? "tree" : "scan",
                        speed.isa);
  }
  return paragraph(
             fmt::format("The worst case: robust as packets runs at <b>{:.2f}</b> of fast ({}).",
                         least, where)) +
         table.html();
}

/// A table of wrong decisions by hard case and solver; a cell's tip shows its other figures.
std::string case_table(Figures& figures) {
  std::vector<std::string> names, columns = {"hard case"};
  for (const CaseErrors& row : figures.cases) {
    if (row.isa != figures.widest) continue;
    const std::string& name = row.errors.contender;
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    names.push_back(name);
    columns.push_back(solver_name(name));
  }
  Table table(columns);
  std::vector<std::string> line;
  for (CaseErrors& row : figures.cases) {
    if (row.isa != figures.widest) continue;
    test::HardFigures& f = row.errors.figures;
    if (line.empty()) line.push_back(row.hard_case);
    const bool any = f.wrong_decisions < f.hits;  // with none right there is no t to judge
    line.push_back(any ? fmt::format("{} | {:.2g} | {:.2g}", f.wrong_decisions + f.wrong_roots,
                                     f.ulp_quantile(0.99), f.max_residual)
                       : fmt::format("{} | - | -", f.wrong_decisions + f.wrong_roots));
    if (line.size() < columns.size()) continue;
    table.add(line);
    line.clear();
  }
  return table.html();
}

std::string sum_table(const Figures& figures) {
  Table table({"solver", "ISA", "pairs", "wrong hits and misses", "in a million"});
  for (const auto& [key, sum] : sum_errors(figures.cases))
    table.add({solver_name(key.second), key.first, std::to_string(sum.pairs),
               std::to_string(sum.wrong), fmt::format("{:.0f}", sum.per_million())});
  return table.html();
}

std::string epsilon_pictures(const Figures& figures) {
  std::string html = "<div class=\"pictures\">\n";
  for (const EpsilonPicture& picture : figures.pictures) {
    html += fmt::format(
        "<figure><img alt=\"{0}\" width=\"{1}\" height=\"{2}\" src=\"{3}\"><figcaption>{0}: {4} "
        "false shadows, {5} leaks</figcaption></figure>\n",
        escaped(picture.remedy), picture.marked.width, picture.marked.height,
        png_uri(picture.marked), picture.false_shadows, picture.leaks);
  }
  return html + "</div>\n";
}

/// "12 %", of the rate at which rays are read, solved once each, and answered.
std::string share_of_one_solve(const PeerRow& row) {
  return row.one_solve > 0 ? fmt::format("{:.0f} %", 100 * row.mrays_per_s / row.one_solve) : "-";
}

std::string peer_section(const Figures& figures) {
  if (!figures.peers) return paragraph("This build found no Embree 3 (libembree-dev).");
  Table table({"scene", "rays", "contender", "solver", "Mray/s", "range", "to best Embree",
               "of one solve", "wrong of", "rays"});
  for (const PeerRow& row : figures.peers->rows)
    table.add(
        {row.scene, row.rays, row.contender, row.solver, fmt::format("{:.3g}", row.mrays_per_s),
         fmt::format("{:.3g} to {:.3g}", row.least, row.most), fmt::format("{:.2f}", row.ratio),
         share_of_one_solve(row), std::to_string(row.mismatches), std::to_string(row.count)});
  return paragraph("Embree " + escaped(figures.peers->embree) +
                   ", every mode of it, built-in spheres and user geometry with a hand-vectorised "
                   "callback, on the same rays in the same process, in turns. Wrong: another hit, "
                   "id or t than single rays on an independent tree in plain double. One solve: "
                   "the rate at which each ray is read, solved once in double against one sphere, "
                   "and answered, without any search.") +
         table.html();
}

std::string provenance(const Figures& figures) {
  const Provenance& p = figures.provenance;
  Table table({"", ""});
  table.add({"machine", fmt::format("{}, {} cores", p.cpu, p.cores)});
  table.add({"compiler", p.compiler});
  table.add({"flags", p.flags + ", kernels -O2, all -ffp-contract=off"});
  table.add({"commit", p.commit});
  table.add(
      {"date", p.date.empty() ? "not given (SOURCE_DATE_EPOCH)" : p.date + " (SOURCE_DATE_EPOCH)"});
  table.add({"made by", p.command});
  table.add({"seeds", fmt::format("epsilons {}; hard cases and scenes: in their sources",
                                  figures.settings.seed)});
  return table.html();
}

std::string speed_section(const Figures& figures) {
  std::string html = paragraph(
      "Each point is one solver compiled for one instruction set. To the left is right, up is "
      "fast. "
      "Errors are counted against an oracle of 1400 bits on the hard cases below; speed is that of "
      "the same code on the scene named, W rays of a camera at a time, all contenders in turns in "
      "one process, medians of thread CPU time. Bundles are how Boule traces a camera's rays: up "
      "to "
      "1024 that share an origin; their hits are those of packets, bit for bit.");
  for (const char* structure : {"scan", "bvh"}) {
    for (const std::string& scene : scenes_of(figures, structure))
      html += figure(speed_chart(figures, scene, structure));
  }
  return html;
}

std::string error_section(Figures& figures) {
  std::string html = paragraph(
      "A unit sphere at a growing distance, aimed at more and more closely beside its rim: half of "
      "the rays should hit, half should miss. Instruction set: " +
      figures.widest + ".");
  for (const char* solver : {"robust", "fast", "closest_approach", "half_b", "half_b_double"})
    html += "<figure>" + draw(error_chart(figures, solver)) + "</figure>\n";
  return html;
}

std::string epsilon_section(const Figures& figures) {
  std::string html = paragraph(
      "What textbooks do against freckles, beside what Boule does: a ray that leaves a surface "
      "knows it by its id and starts from a point in double. Points whose truth is beyond a long "
      "double are left out.");
  for (const char* experiment : {"scale", "distance", "ground"})
    html += figure(epsilon_chart(figures, experiment));
  return html + epsilon_pictures(figures);
}

/// The error of random samples after so many seconds: interpolated between measured points on
/// logarithmic axes, beyond the last one extrapolated as 1 / sqrt(time).
double error_after(double seconds, const std::vector<PathError>& errors) {
  const auto after = std::find_if(errors.begin(), errors.end(),
                                  [&](const PathError& e) { return e.seconds >= seconds; });
  if (after == errors.begin()) return after->error;
  const PathError& before = *(after - 1);
  const double share = std::log(seconds / before.seconds);
  if (after == errors.end()) return before.error * std::exp(-share / 2);
  const double slope =
      std::log(after->error / before.error) / std::log(after->seconds / before.seconds);
  return before.error * std::exp(share * slope);
}

std::string path_section(const Figures& figures) {
  std::string html = paragraph(fmt::format(
      "Pictures of {} x {} pixels with 1, 2, 4, ... samples each, against one of eight times as "
      "many as the last. The samples of a pixel are points of one scrambled sequence, or each is "
      "drawn by itself, as random numbers are; all else is the same code, and so is its cost.",
      PathPicture::width, PathPicture::height));
  Table table({"scene", "seconds", "error, Sobol", "error, random", "ratio", "random takes"});
  for (const ScenePathErrors& scene : figures.paths) {
    html += figure(path_error_chart(scene));
    const PathError& last = scene.errors.sequence.back();
    const double random = error_after(last.seconds, scene.errors.random);
    const double ratio = random / last.error;
    table.add({scene.scene, fmt::format("{:.3g}", last.seconds), fmt::format("{:.3g}", last.error),
               fmt::format("{:.3g}", random), fmt::format("{:.2f}", ratio),
               fmt::format("{:.1f} times as long", ratio * ratio)});
  }
  return html + table.html();
}

std::string noise_section(const Figures& figures) {
  std::string html = paragraph(
      "Pictures with 16, 32, 64 ... samples in every pixel, and pictures whose pixels have as many "
      "as they need for a noise of 0.16, 0.08, 0.04 and 0.02, against one with many more. Errors "
      "are differences in displayed values, of the channel where they are greatest.");
  Table table({"scene", "noise asked for", "samples a pixel", "seconds", "99 % within",
               "as many everywhere take", "at random"});
  for (const SceneNoiseErrors& scene : figures.noise) {
    html += figure(noise_chart(scene));
    for (const NoiseError& e : scene.errors.to_order) {
      const auto times = [&e](const std::vector<NoiseError>& others) {
        return fmt::format("{:.2f} times as long", seconds_until(e.within_99, others) / e.seconds);
      };
      table.add({scene.scene, fmt::format("{:.3g}", e.asked), fmt::format("{:.1f}", e.mean_samples),
                 fmt::format("{:.3g}", e.seconds), fmt::format("{:.3g}", e.within_99),
                 times(scene.errors.uniform), times(scene.errors.random)});
    }
  }
  return html + table.html();
}

}  // namespace

std::string to_html(Figures& figures) {
  std::string html = page_head("Boule: speed against error");
  html += "<h1>Boule: speed against error</h1>\n" +
          paragraph(
              "A ray tracer for spheres and planes that gives exact hits at float speed. Every "
              "figure on this page was measured by the run that wrote it.") +
          provenance(figures);
  html += section("Speed against error", speed_section(figures) + cost_table(figures));
  html += section("Where errors live", error_section(figures));
  html +=
      section("The hard cases",
              paragraph("Three columns: wrong hits, misses and roots | error of t in ulp, p99 | "
                        "greatest distance of the hit from the surface in u max(F, r), u = "
                        "2<sup>-24</sup>. Instruction set: " +
                        figures.widest + ".") +
                  solver_table(figures) + case_table(figures) + sum_table(figures));
  html += section("Shadows without an epsilon", epsilon_section(figures));
  html += section("Growth", figure(growth_chart(figures)) + figure(secondary_chart(figures)));
  html += section("Path tracing: error at equal time", path_section(figures));
  html += section("Noise to order", noise_section(figures));
  html += section("Embree", peer_section(figures));
  return html + page_end();
}

std::string main_scene(const Figures& figures) {
  const std::vector<std::string> scenes = scenes_of(figures, "bvh");
  return scenes.size() > 1 ? scenes[1] : scenes.at(0);
}

std::string main_chart(Figures& figures) {
  return draw_alone(speed_chart(figures, main_scene(figures), "bvh"));
}

std::string path_chart(const Figures& figures) {
  return figures.paths.empty() ? "" : draw_alone(path_error_chart(figures.paths.front()));
}

}  // namespace boule::bench
