#include "bench/report/peer_rows.h"

#ifdef BOULE_HAS_PEERS

#include <cstdio>

#include "bench/peers/embree/embree_peer.h"
#include "bench/peers/referee.h"

namespace boule::bench {

std::optional<PeerRows> measure_peers(bool quick) {
  RefereeSettings settings;
  settings.scenes = quick ? std::vector<std::string>{"u1000", "flake4"} : scene_names();
  if (quick) {
    settings.scenes.emplace_back("sticks24");
  } else {  // round linear curves, too
    settings.scenes.insert(settings.scenes.end(), {"sticks24", "sticks50000", "cell1000000"});
  }
  settings.kinds = {RayKind::primary, RayKind::shadow};
  settings.isas = embree_isas();
  if (settings.isas.empty()) return std::nullopt;
  settings.embree_isas = {settings.isas.back()};
  settings.repetitions = quick ? 3 : 5;
  settings.patience = 8;
  settings.side = quick ? 512 : 1024;
  PeerRows result{embree_version(), {}};
  const auto report = [&](const Check& check, const std::vector<Row>& rows) {
    std::fprintf(stderr, "  %s %s\n", check.scene.c_str(), check.rays.c_str());
    for (const Row& row : rows)
      result.rows.push_back({row.scene, row.rays, row.contender, row.solver, row.median, row.min,
                             row.max, row.ratio_to_best_embree, check.count, row.mismatches,
                             check.one_solve});
  };
  if (!compare(settings, report)) return std::nullopt;
  return result;
}

}  // namespace boule::bench

#else

namespace boule::bench {

std::optional<PeerRows> measure_peers(bool /*quick*/) { return std::nullopt; }

}  // namespace boule::bench

#endif
