#include "bench/peers/summary.h"

#include <algorithm>
#include <cstdio>

#include "bench/peers/embree/embree_peer.h"
#include "bench/tools/median.h"

namespace boule::bench {
namespace {

/// Whether an instruction set of Boule is held against Embree limited to the same.
bool is_limited(const RefereeSettings& settings, const std::string& isa) {
  const auto& isas = settings.embree_isas;
  return isa == "avx2" && std::find(isas.begin(), isas.end(), isa) != isas.end();
}

/// One table's ratios, which are 0 where there are no such rays.
class Ratios {
 public:
  Ratios(const Results& results, const RefereeSettings& settings, const std::string& isa)
      : settings_(settings), columns_(settings.kinds.size()) {
    const bool limited = is_limited(settings, isa);
    for (const Row& row : results.rows) {
      if (row.contender != "boule-" + isa) continue;
      const double ratio = limited ? row.ratio_within_isa : row.ratio_to_best_embree;
      columns_[column_of(row.rays)].push_back({row.scene, ratio});
    }
  }

  void print() const {
    std::printf("%-16s", "scene");
    for (const RayKind kind : settings_.kinds) std::printf(" %12s", name_of(kind).c_str());
    for (const std::string& scene : settings_.scenes)
      print_line(scene.c_str(), [&](const Column& column) { return ratio_of(column, scene); });
    print_line("least", [](const Column& column) { return figures(column).front(); });
    print_line("median", [](const Column& column) { return median(figures(column)); });
    std::printf("\n");
  }

 private:
  struct Cell {
    std::string scene;
    double ratio;
  };
  using Column = std::vector<Cell>;

  [[nodiscard]] std::size_t column_of(const std::string& rays) const {
    const auto kind = std::find_if(settings_.kinds.begin(), settings_.kinds.end(),
                                   [&](RayKind one) { return name_of(one) == rays; });
    return static_cast<std::size_t>(kind - settings_.kinds.begin());
  }
  static double ratio_of(const Column& column, const std::string& scene) {
    const auto cell = std::find_if(column.begin(), column.end(),
                                   [&](const Cell& one) { return one.scene == scene; });
    return cell == column.end() ? 0 : cell->ratio;
  }
  /// In order.
  static std::vector<double> figures(const Column& column) {
    std::vector<double> all;
    for (const Cell& cell : column) all.push_back(cell.ratio);
    std::sort(all.begin(), all.end());
    return all;
  }
  void print_line(const char* name, const auto& figure) const {
    std::printf("\n%-16s", name);
    for (const Column& column : columns_)
      std::printf(" %12.2f", column.empty() ? 0 : figure(column));
  }

  const RefereeSettings& settings_;
  std::vector<Column> columns_;
};

}  // namespace

void print_summary(const Results& results, const RefereeSettings& settings) {
  for (const std::string& isa : settings.isas) {
    std::printf("\nboule-%s, ratio to the best of Embree %s's modes%s\n", isa.c_str(),
                embree_version().c_str(), is_limited(settings, isa) ? " limited to AVX2" : "");
    Ratios(results, settings, isa).print();
  }
}

}  // namespace boule::bench
