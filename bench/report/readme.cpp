// The README's table of figures: written by the run that measured them, like the page.
#include <fmt/format.h>

#include <algorithm>

#include "bench/report/figures.h"

namespace boule::bench {
namespace {

constexpr const char* begin_mark = "<!-- report: begin -->\n";
constexpr const char* end_mark = "<!-- report: end -->\n";
// A test looks for the first line in the report of the commit that was measured.
constexpr const char* table_header =
    "| scene | primary: Embree | Boule | ratio | shadow: Embree | Boule | ratio "
    "| wrong: Embree | Boule |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
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

/// A scene that both have traced.
struct SceneDuels {
  std::string scene;
  Duel primary, shadow;

  [[nodiscard]] std::size_t wrong(const PeerRow* Duel::*contender) const {
    return (primary.*contender)->mismatches + (shadow.*contender)->mismatches;
  }
};

std::vector<SceneDuels> duels_of(const PeerRows& peers) {
  std::vector<SceneDuels> duels;
  for (const std::string& scene : scenes_of(peers)) {
    const SceneDuels both{scene, find_duel(peers, scene, "primary"),
                          find_duel(peers, scene, "shadow")};
    if (both.primary.complete() && both.shadow.complete() && duels.size() < most_rows)
      duels.push_back(both);
  }
  return duels;
}

/// "1.7 to 3.8", or one number where both are the same.
template <class Number>
std::string range_of(const std::vector<Number>& numbers, const char* format) {
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const std::string first = fmt::format(fmt::runtime(format), *least);
  const std::string last = fmt::format(fmt::runtime(format), *most);
  return first == last ? first : first + " to " + last;
}

/// The two claims that are measured, a line or two each.
std::string claims(const PeerRows& peers, const std::vector<SceneDuels>& duels) {
  std::vector<double> primary, shadow;
  std::vector<std::size_t> wrong;
  std::size_t ours = 0;
  for (const SceneDuels& scene : duels) {
    primary.push_back(scene.primary.boule->ratio);
    shadow.push_back(scene.shadow.boule->ratio);
    wrong.push_back(scene.wrong(&Duel::embree));
    ours += scene.wrong(&Duel::boule);
  }
  return fmt::format(
      "- **Fast.** {} times as many primary rays a second as Embree {}, and {} times as many\n"
      "  shadow rays ([repeat it](docs/howto/claims.md#how-fast)).\n"
      "- **Exact.** {} wrong hits. Embree returns {} wrong hits in each of these scenes\n"
      "  ([repeat it](docs/howto/claims.md#how-fast)).\n\n",
      range_of(primary, "{:.1f}"), peers.embree, range_of(shadow, "{:.1f}"), ours,
      range_of(wrong, "{}"));
}

/// A row for each scene: its primary rays, its shadow rays, and how many both got wrong together.
std::string scene_rows(const std::vector<SceneDuels>& duels) {
  std::string lines = table_header;
  for (const SceneDuels& scene : duels) {
    lines += fmt::format("| {} |", scene.scene);
    for (const Duel& duel : {scene.primary, scene.shadow}) {
      lines += fmt::format(" {:.3g} | {:.3g} | {:.2f} |", duel.embree->mrays_per_s,
                           duel.boule->mrays_per_s, duel.boule->ratio);
    }
    lines += fmt::format(" {} | {} |\n", scene.wrong(&Duel::embree), scene.wrong(&Duel::boule));
  }
  return lines;
}

std::string table(const Figures& figures) {
  const Provenance& p = figures.provenance;
  const std::string measured =
      fmt::format("Measured on {}, {}, commit {}{}, by `{}`", p.cpu, p.compiler, p.commit,
                  p.date.empty() ? "" : ", " + p.date, p.command);
  const std::vector<SceneDuels> duels =
      figures.peers ? duels_of(*figures.peers) : std::vector<SceneDuels>{};
  if (duels.empty()) return measured + ". This build found no Embree to compare with.\n";
  return claims(*figures.peers, duels) + scene_rows(duels) +
         fmt::format(
             "\n{}: one thread, {}, million rays a second, the same {} camera rays of each scene, "
             "Embree in the best of its modes. A hit is wrong if an independent tree in double "
             "finds another one. uN: N balls at random; flakeN: a sphereflake of N levels.\n",
             measured, figures.widest, figures.peers->rows.front().count);
}

}  // namespace

std::optional<std::string> with_table(const std::string& readme, const Figures& figures) {
  const std::size_t begin = readme.find(begin_mark), end = readme.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return std::nullopt;
  return readme.substr(0, begin) + begin_mark + table(figures) + readme.substr(end);
}

}  // namespace boule::bench
