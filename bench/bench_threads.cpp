// How pictures and the preparation of many spheres scale with threads: 1, 2, 4 ... in turns, by the
// clock, medians; the pictures must have the same bits.
//   bench_threads [--repetitions N] [--width N] [--height N] [--spp N] [--spheres N] SCENE...
//                                                                              SCENE: .toml
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/scenes/uniform_spheres.h"
#include "bench/tools/median.h"
#include "bench/tools/wall_seconds.h"
#include "render/files/scene_file/scene_file.h"
#include "render/renderer/renderer.h"

namespace boule::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes;
  int width = 1280, height = 720;
  int repetitions = 3;
  int spp = 16;
  std::size_t spheres = 0;  ///< of a scene uN whose preparation is timed; 0: none
};

/// `run` returns the seconds that as many threads take; all numbers of threads take turns.
template <class Run>
void compare(const std::string& what, int repetitions, const Run& run) {
  const std::vector<unsigned> counts = thread_counts();
  std::vector<std::vector<double>> times(counts.size());
  for (int i = 0; i < repetitions; ++i) {
    for (std::size_t k = 0; k < counts.size(); ++k) times[k].push_back(run(counts[k]));
  }
  const double one = median(times[0]);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double time = median(times[k]);
    std::printf("%-28s %3u threads %8.3f s, %6.2f times as fast, efficiency %5.1f %%\n",
                what.c_str(), counts[k], time, one / time, 100 * one / time / counts[k]);
  }
  std::fflush(stdout);
}

/// A failure that leaves nothing to measure.
[[noreturn]] void fail(const Diagnostic& error) {
  std::fprintf(stderr, "%s\n", format_diagnostic(error).c_str());
  std::exit(3);
}

void compare_pictures(const std::string& file, const Arguments& arguments) {
  auto loaded = load_scene(file);
  if (!loaded) fail(loaded.error());
  const Scene scene = std::move(loaded).value().scene;
  RenderOptions options = options_of(scene);
  options.noise = 0;
  options.spp = arguments.spp;
  options.width = arguments.width;
  options.height = arguments.height;
  std::vector<Color> expected;
  const auto run = [&](unsigned threads) {
    options.threads = threads;
    auto renderer = Renderer::create(scene, options);
    if (!renderer) fail(renderer.error());
    Image image;
    const double time = wall_seconds([&] { image = renderer.value().render().value(); });
    if (expected.empty()) expected = image.pixels;
    if (image.pixels != expected) std::abort();
    return time;
  };
  compare(std::filesystem::path(file).stem().string(), arguments.repetitions, run);
}

/// From the spheres in memory to a renderer that is ready.
void compare_preparation(const Arguments& arguments) {
  const std::vector<Sphere> spheres = uniform_spheres(arguments.spheres);
  RenderOptions options;
  options.width = 64;
  options.height = 36;
  const auto run = [&](unsigned threads) {
    Scene scene;
    scene.materials.push_back({});
    scene.spheres = spheres;
    options.threads = threads;
    std::optional<Result<Renderer>> renderer;  // is destroyed untimed
    const double time =
        wall_seconds([&] { renderer.emplace(Renderer::create(std::move(scene), options)); });
    if (!*renderer) fail(renderer->error());
    return time;
  };
  compare("u" + std::to_string(arguments.spheres) + ", prepared", arguments.repetitions, run);
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  CLI::App app("Times pictures and the preparation of many spheres with 1, 2, 4 ... threads.");
  boule::bench::Arguments arguments;
  app.add_option("scenes", arguments.scenes, "Scene files, .toml");
  app.add_option("--width", arguments.width, "Of the pictures, in pixels")
      ->check(CLI::Range(1, 65535));
  app.add_option("--height", arguments.height, "Likewise")->check(CLI::Range(1, 65535));
  app.add_option("--spp", arguments.spp, "Samples a pixel")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", arguments.repetitions, "Medians of so many")
      ->check(CLI::PositiveNumber);
  app.add_option("--spheres", arguments.spheres, "Prepares so many random spheres as well");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& scene : arguments.scenes)
    boule::bench::compare_pictures(scene, arguments);
  if (arguments.spheres > 0) boule::bench::compare_preparation(arguments);
  return 0;
}
