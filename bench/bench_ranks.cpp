// How well many ranks share a picture: a simulation with the program's own dealer of blocks, block
// costs that were recorded, and a network of 1 GB/s and 20 us.
//
//   bench_ranks SCENE [core hours]
//
// Renders SCENE at 3840 x 2160 with one sample per pixel on one thread, and records what each block
// of 16 x 16 pixels costs in processor time, the smaller of two. The costs are scaled so that the
// whole picture takes so many core hours (1, 10 and 100), and dealt to 1 .. 1024 ranks of one
// thread each.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "bench/rank_simulation.h"
#include "bench/tools/thread_seconds.h"
#include "render/apps/parts/part_blocks.h"
#include "render/apps/team/block_dealer.h"
#include "render/files/scene_file/scene_file.h"
#include "render/frame/pixel_order.h"
#include "render/renderer/block_tools.h"
#include "render/renderer/renderer.h"

namespace boule::bench {
namespace {

constexpr int finest = 16;  // pixels on a side of the blocks that are recorded
constexpr PixelRect picture{0, 0, 3840, 2160};

/// Seconds of each finest block, row by row.
std::vector<double> recorded_costs(Scene&& scene) {
  RenderOptions options = options_of(scene);
  options.width = picture.width();
  options.height = picture.height();
  options.spp = 1;
  options.tile = finest;
  options.threads = 1;
  auto renderer = Renderer::create(std::move(scene), options);
  if (!renderer) {
    std::fprintf(stderr, "%s\n", format_diagnostic(renderer.error()).c_str());
    std::exit(1);
  }
  std::vector<double> costs;
  const BlockOrder blocks(picture, finest, PixelOrder::rows);
  const auto status = renderer.value().work([&](BlockTools& tools) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      double least = 1e9;
      for (int repetition = 0; repetition < 2; ++repetition) {
        Film film(blocks[i]);
        const double begin = thread_seconds();
        tools.render(blocks[i], 1, film);
        least = std::min(least, thread_seconds() - begin);
      }
      costs.push_back(least);
    }
  });
  if (!status) std::exit(1);
  return costs;
}

/// The costs of the blocks of this side, in the order in which they are dealt.
std::vector<double> costs_of_blocks(const std::vector<double>& finest_costs, int tile) {
  const int columns = (picture.width() + finest - 1) / finest;
  std::vector<double> costs;
  for (const PixelRect& block : blocks_of_shard(picture, tile, {})) {
    double cost = 0;
    for (int y = block.y0; y < block.y1; y += finest) {
      for (int x = block.x0; x < block.x1; x += finest)
        cost += finest_costs[static_cast<std::size_t>(y / finest * columns + x / finest)];
    }
    costs.push_back(cost);
  }
  return costs;
}

void tell(const std::vector<double>& costs, double hours) {
  const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
  std::printf("%g core hours\n%7s %6s %8s %10s %11s %9s\n", hours, "ranks", "tile", "blocks",
              "seconds", "efficiency", "letters");
  for (int ranks = 1; ranks <= 1024; ranks *= 2) {
    SimulatedRun run;
    const int tile = shared_tile(picture, ranks, BlockDealer::blocks_each);
    run.costs = costs_of_blocks(costs, tile);
    for (double& cost : run.costs) cost *= hours * 3600 / all;
    run.block_bytes = 32.0 * tile * tile;
    run.ranks = ranks;
    const SimulatedEnd end = simulate(run);
    std::printf("%7d %6d %8zu %10.2f %10.1f%% %9llu\n", ranks, tile, run.costs.size(), end.seconds,
                100 * end.efficiency, static_cast<unsigned long long>(end.letters));
  }
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: bench_ranks SCENE [core hours]\n");
    return 2;
  }
  auto loaded = boule::load_scene(argv[1]);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", format_diagnostic(loaded.error()).c_str());
    return 1;
  }
  const auto costs = boule::bench::recorded_costs(std::move(loaded.value().scene));
  if (argc == 3) {
    boule::bench::tell(costs, std::atof(argv[2]));
  } else {
    for (const double hours : {1.0, 10.0, 100.0}) boule::bench::tell(costs, hours);
  }
  return 0;
}
