// The README's table of figures: written by the run that measured them, like the page.
#include <fmt/format.h>

#include <algorithm>

#include "bench/report/figures.h"

namespace boule::bench {
namespace {

constexpr const char* begin_mark = "<!-- report: begin -->\n";
constexpr const char* end_mark = "<!-- report: end -->\n";
constexpr std::size_t most_rows = 8;  // a first look; the page has them all

/// The best of Embree and the widest of Boule on the same rays.
struct Duel {
  const PeerRow* embree = nullptr;
  const PeerRow* boule = nullptr;

  [[nodiscard]] bool complete() const { return embree != nullptr && boule != nullptr; }
};

/// Boule's rows come in the order of their ISAs, the widest last.
Duel find_duel(const PeerRows& peers, const std::string& scene, const std::string& rays) {
  Duel duel;
  for (const PeerRow& row : peers.rows) {
    if (row.scene != scene || row.rays != rays) continue;
    if (row.contender.starts_with("embree")) {
      if (duel.embree == nullptr || duel.embree->mrays_per_s < row.mrays_per_s) duel.embree = &row;
    } else if (row.contender == "boule-avx2" || row.contender == "boule-avx512") {
      duel.boule = &row;
    }
  }
  return duel;
}

std::vector<std::string> scenes_of(const PeerRows& peers) {
  std::vector<std::string> scenes;
  for (const PeerRow& row : peers.rows) {
    if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end())
      scenes.push_back(row.scene);
  }
  return scenes;
}

/// A row for each scene: its primary rays, its shadow rays, and what both got wrong together.
std::string scene_rows(const PeerRows& peers) {
  std::string lines =
      "| scene | primary rays: Embree | Boule | ratio | shadow rays: Embree | Boule | ratio | "
      "wrong: "
      "Embree | Boule |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  std::size_t rows = 0;
  for (const std::string& scene : scenes_of(peers)) {
    const Duel primary = find_duel(peers, scene, "primary");
    const Duel shadow = find_duel(peers, scene, "shadow");
    if (!primary.complete() || !shadow.complete() || rows == most_rows) continue;
    lines += fmt::format("| {} |", scene);
    for (const Duel& duel : {primary, shadow}) {
      lines += fmt::format(" {:.3g} | {:.3g} | {:.2f} |", duel.embree->mrays_per_s,
                           duel.boule->mrays_per_s, duel.boule->ratio);
    }
    lines += fmt::format(" {} | {} |\n", primary.embree->mismatches + shadow.embree->mismatches,
                         primary.boule->mismatches + shadow.boule->mismatches);
    ++rows;
  }
  return lines;
}

std::string table(const Figures& figures) {
  const Provenance& p = figures.provenance;
  std::string text =
      fmt::format("Measured on {}, {}, commit {}{}, by `{}`; one thread, {}.", p.cpu, p.compiler,
                  p.commit, p.date.empty() ? "" : ", " + p.date, p.command, figures.widest);
  if (!figures.peers || figures.peers->rows.empty())
    return text + " This build found no Embree to compare with.\n";
  text += fmt::format(
      " Million rays per second beside Embree {}, the best of its modes, on the same rays ({} of a "
      "camera for each scene); wrong: another hit than an independent tree in double finds.\n\n",
      figures.peers->embree, figures.peers->rows.front().count);
  return text + scene_rows(*figures.peers);
}

}  // namespace

std::optional<std::string> with_table(const std::string& readme, const Figures& figures) {
  const std::size_t begin = readme.find(begin_mark), end = readme.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return std::nullopt;
  return readme.substr(0, begin) + begin_mark + table(figures) + readme.substr(end);
}

}  // namespace boule::bench
