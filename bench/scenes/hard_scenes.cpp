#include "bench/scenes/hard_scenes.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace boule::bench {
namespace {

void copy_twice(BenchScene& scene, float below, float above) {
  const std::size_t size = scene.spheres.size();
  for (const float towards : {below, above}) {
    for (std::size_t i = 0; i < size; ++i) {
      Sphere copy = scene.spheres[i];
      if (towards != 0) copy.center.z = std::nextafter(copy.center.z, towards);
      scene.spheres.push_back(copy);
    }
  }
}

/// Radii of 1e-6 at a distance of 4, where floats are dense: around the origin, seen along an axis.
void move_away(BenchScene& scene) {
  const float size = 1e-6F / scene.spheres[0].radius;  // of the cube
  for (Sphere& sphere : scene.spheres) {
    sphere.center = (sphere.center - Vec3f{0.5F, 0.5F, 0.5F}) * size;
    sphere.radius *= size;
  }
  scene.camera.pose = {{0, 0, -4}, {0, 0, 0}, {0, 1, 0}};
  scene.camera.fov = 57.3F * size / 4;
  scene.light.position = {-1, 7, -5};
}

void shift(BenchScene& scene, const Vec3f& by) {
  for (Sphere& sphere : scene.spheres) sphere.center = sphere.center + by;
  scene.camera.pose.eye = scene.camera.pose.eye + by;
  scene.camera.pose.look_at = scene.camera.pose.look_at + by;
  scene.light.position = scene.light.position + by;
}

struct HardScene {
  const char* name;
  void (*change)(BenchScene&);
};

constexpr std::array hard_scenes = {
    HardScene{"copies", [](BenchScene& scene) { copy_twice(scene, 0, 0); }},
    HardScene{"near-copies", [](BenchScene& scene) { copy_twice(scene, -9, 9); }},
    HardScene{"far", move_away},
    HardScene{"shifted",
              [](BenchScene& scene) {
                shift(scene, {1e5F, -1e5F, 1e5F});
              }},
    HardScene{"ground",
              [](BenchScene& scene) {
                scene.spheres.push_back({{0.5F, -1e6F, 0.5F}, 1e6F, 0});
              }},
    HardScene{"inside", [](BenchScene& scene) {
                scene.camera.pose.eye = {0.5F, 0.5F, 0.45F};
                scene.spheres.push_back({{0.5F, 0.5F, 0.45F}, 0.01F, 0});
                scene.spheres.push_back({{0.5F, 0.5F, 0.5F}, 3, 0});
              }}};

}  // namespace

std::vector<std::string> hard_scene_names() {
  std::vector<std::string> names;
  for (const HardScene& scene : hard_scenes) names.emplace_back(scene.name);
  return names;
}

std::optional<BenchScene> make_hard_scene(const std::string& name, BenchScene u1000) {
  for (const HardScene& scene : hard_scenes) {
    if (name != scene.name) continue;
    scene.change(u1000);
    u1000.name = name;
    return u1000;
  }
  return std::nullopt;
}

}  // namespace boule::bench
