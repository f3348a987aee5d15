#include "bench/scenes/bench_scenes.h"

#include <charconv>

#include "bench/scenes/balls.h"
#include "bench/scenes/hard_scenes.h"
#include "bench/scenes/particle_scenes.h"
#include "bench/scenes/stick_scenes.h"
#include "bench/scenes/uniform_spheres.h"

namespace boule::bench {
namespace {

constexpr int deepest_flake = 6;

BenchScene random_scene(const std::string& name, int n) {
  BenchScene scene;
  scene.name = name;
  scene.spheres = uniform_spheres(static_cast<std::size_t>(n));
  scene.camera.pose = {{0.5F, 0.5F, -1.2F}, {0.5F, 0.5F, 0.5F}, {0, 1, 0}};
  scene.camera.fov = 25.61F;
  scene.radius = 0.87F;
  scene.light.position = {0.3F, 2, -1.5F};
  return scene;
}

BenchScene flake_scene(const std::string& name, int depth) {
  BenchScene scene;
  scene.name = name;
  scene.spheres = balls(depth);
  scene.camera.pose = {{2.1F, 1.3F, 1.7F}, {0, 0, 0}, {0, 0, 1}};
  scene.camera.fov = 45;
  scene.light.position = {4, 3, 2};
  return scene;
}

}  // namespace

std::vector<std::string> scene_names() {
  return {"u1000", "u10000", "u100000", "u1000000", "flake4", "flake6"};
}

Result<BenchScene> make_scene(const std::string& name) {
  if (const auto n = number_after("u", name, 1, most_random)) return random_scene(name, *n);
  if (const auto depth = number_after("flake", name, 0, deepest_flake)) {
    return flake_scene(name, *depth);
  }
  if (auto scene = make_particle_scene(name)) return *std::move(scene);
  if (auto scene = make_stick_scene(name)) return *std::move(scene);
  if (auto scene = make_hard_scene(name, random_scene("u1000", 1000))) return *std::move(scene);
  std::string others;
  for (const std::string& hard : hard_scene_names()) others += ", " + hard;
  return Diagnostic::of(
      "no scene " + quote(name) +
      ", expected uN or cellN, N from 1 to 10000000, flakeD, D from 0 to 6, proteinN, groundN, "
      "grainsN, ringN or slabN, N from 10 to 10000000, sticksN, N from 24 to 1000000" +
      others);
}

std::optional<int> number_after(std::string_view prefix, std::string_view name, int low, int high) {
  if (!name.starts_with(prefix)) return std::nullopt;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
  const bool whole = error == std::errc{} && stop == end;
  if (!whole || number < low || number > high) return std::nullopt;
  return number;
}

}  // namespace boule::bench
