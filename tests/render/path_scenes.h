#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// A closed room with everything that path tracing can meet: a sphere light, a lamp, every
/// material.
inline Scene path_scene(int width, int height) {
  Scene scene = empty_scene(width, height);
  scene.camera = pinhole({0.4f, 1.8f, 7}, {0, 0.9f, 0}, 42);
  scene.render.method = Method::path;
  scene.render.max_depth = 6;
  const auto floor = add_material(scene, Matte{{0.6f, 0.55f, 0.5f}});
  const auto paint = add_material(scene, Plastic{{0.2f, 0.3f, 0.6f}, 0.3f, 20, 0.1f});
  const auto gold = add_material(scene, Metal{{0.9f, 0.7f, 0.4f}});
  const auto glass = add_material(scene, Glass{{0.95f, 1, 0.95f}, 1.5f});
  const auto lamp = add_material(scene, Emissive{{5, 4, 3}});
  const auto phong =
      add_material(scene, Phong{{0.5f, 0.4f, 0.3f}, 0.2f, 0.5f, 0.2f, 7, 0.2f, 1.2f});
  scene.spheres = {{{-1.9f, 1, 0}, 1, paint},         {{0, 1, 0}, 0.9f, gold},
                   {{1.9f, 0.8f, 0.3f}, 0.8f, glass}, {{0.9f, 0.3f, 1.7f}, 0.3f, phong},
                   {{-0.9f, 0.4f, 1.6f}, 0.4f, lamp}, {{0.2f, 0.2f, 2.2f}, 0.2f, floor}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}, {{0, 0, -3}, {0, 0, 1}, floor}};
  scene.lights = {SphereLight{{2, 4, 3}, 0.8f, {6, 6, 7}},
                  PointLight{{-3, 4, 2}, {0.3f, 0.3f, 0.3f}, Falloff::none}};
  return scene;
}

inline double luminance(const Color& c) {
  return (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) / 3;
}

/// Mean and variance of numbers that are added one by one (Welford 1962).
struct Moments {
  double mean = 0, squares = 0;
  int count = 0;

  void add(double x) {
    ++count;
    const double off = x - mean;
    mean += off / count;
    squares += off * (x - mean);
  }
  [[nodiscard]] double variance() const { return squares / (count - 1); }
  [[nodiscard]] double variance_of_mean() const { return variance() / count; }
};

}  // namespace boule::test
