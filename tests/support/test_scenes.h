#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// Adds a material and returns its index.
inline std::uint32_t add_material(Scene& scene, const Material& material) {
  const std::size_t index = scene.materials.size();
  scene.materials.push_back({std::to_string(index), material});
  return static_cast<std::uint32_t>(index);
}

inline PinholeCamera pinhole(const Vec3f& eye, const Vec3f& look_at, float fov) {
  return {{eye, look_at, {0, 1, 0}}, fov, FovAxis::x};
}

/// A small picture of `width` x `height` pixels with a camera at (0, 0, 5) that looks at 0.
inline Scene empty_scene(int width, int height) {
  Scene scene;
  scene.image = {width, height, 1};
  scene.camera = pinhole({0, 0, 5}, {0, 0, 0}, 45);
  return scene;
}

/// Every kind of material and light at once: spheres that touch, overlap and contain each other,
/// over a reflecting plane and under a gradient.
inline Scene mixed_scene(int width, int height) {
  Scene scene = empty_scene(width, height);
  scene.camera = pinhole({0.5f, 1.6f, 6}, {0, 0.8f, 0}, 50);
  scene.background = GradientBackground{};
  scene.ambient = {0.02f, 0.03f, 0.04f};
  const auto matte = add_material(scene, Matte{{0.7f, 0.3f, 0.2f}});
  const auto plastic = add_material(scene, Plastic{{0.2f, 0.6f, 0.3f}, 0.3f, 40, 0.2f});
  const auto metal = add_material(scene, Metal{{0.9f, 0.8f, 0.6f}});
  const auto glass = add_material(scene, Glass{{0.9f, 1.0f, 0.95f}, 1.5f});
  const auto lamp = add_material(scene, Emissive{{2, 1.5f, 1}});
  const auto phong =
      add_material(scene, Phong{{0.3f, 0.4f, 0.8f}, 0.1f, 0.5f, 0.3f, 20, 0.4f, 1.3f});
  const auto floor = add_material(scene, Phong{{0.5f, 0.5f, 0.5f}, 0, 0.8f, 0.2f, 5, 0, 1});
  scene.spheres = {{{-1.8f, 1, 0}, 1, metal},        {{0, 1, 0.5f}, 1, glass},
                   {{0, 1, 0.5f}, 0.4f, matte},      {{1.9f, 0.8f, 0}, 0.8f, phong},
                   {{0.8f, 0.3f, 2}, 0.3f, plastic}, {{-0.9f, 0.35f, 1.8f}, 0.35f, glass},
                   {{-0.4f, 2.6f, -1}, 0.3f, lamp},  {{1, 1.2f, -2}, 1.2f, plastic}};
  scene.planes = {{{0, 0, 0}, {0, 2, 0}, floor}, {{0, 0, -6}, {0, 0.2f, 1}, matte}};
  scene.lights = {PointLight{{3, 5, 4}, {0.6f, 0.6f, 0.5f}, Falloff::none},
                  PointLight{{-2, 3, 2}, {3, 3, 4}, Falloff::inverse_square},
                  DirectionalLight{{0.3f, -1, -0.4f}, {0.3f, 0.25f, 0.2f}}};
  return scene;
}

/// Glass and mirror spheres close together, which make deep trees of rays.
inline Scene glass_cloud(int width, int height) {
  Scene scene = empty_scene(width, height);
  scene.background = GradientBackground{};
  scene.render.max_depth = 8;
  const auto glass = add_material(scene, Glass{});
  const auto metal = add_material(scene, Metal{{0.9f, 0.9f, 0.9f}});
  CaseRandom random(7);
  for (int i = 0; i < 40; ++i) {
    Sphere sphere;
    const Vec3d direction = random.direction();
    const double distance = random.uniform(0, 1.5);
    sphere.center = vec_cast<float>(direction * distance);
    sphere.radius = static_cast<float>(random.uniform(0.2, 0.5));
    sphere.material = i % 4 == 0 ? metal : glass;
    scene.spheres.push_back(sphere);
  }
  return scene;
}

/// The scene with everything in it moved by `by`.
inline Scene moved(Scene scene, const Vec3f& by) {
  for (Sphere& s : scene.spheres) s.center = s.center + by;
  for (Plane& p : scene.planes) p.point = p.point + by;
  for (Light& l : scene.lights) {
    if (auto* point = std::get_if<PointLight>(&l)) point->position = point->position + by;
    if (auto* sphere = std::get_if<SphereLight>(&l)) sphere->center = sphere->center + by;
  }
  std::visit([&](auto& c) { c.pose.eye = c.pose.eye + by, c.pose.look_at = c.pose.look_at + by; },
             *scene.camera);
  return scene;
}

}  // namespace boule::test
