// Cameras and boxes of scenes whose instances show many spheres are, bit for bit, those of the
// scene written out, though few of the spheres are looked at.
#include "render/prepare/shown_extremes.h"

#include <gtest/gtest.h>

#include "core/optics/camera_builder.h"
#include "render/prepare/default_camera.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

Vec3f random_vector(CaseRandom& random, double spread) {
  const double x = random.uniform(-spread, spread), y = random.uniform(-spread, spread);
  return vec_cast<float>(Vec3d{x, y, random.uniform(-spread, spread)});
}

Group cloud(CaseRandom& random, int count) {
  Group group{"cloud", {}, {}, {}};
  for (int i = 0; i < count; ++i) {
    const auto radius = static_cast<float>(random.uniform(0.01, 0.1));
    group.spheres.push_back({random_vector(random, 1), radius, 0});
  }
  return group;
}

/// Spheres of one size side by side: many are outermost.
Group grid(int high) {
  Group group{"grid", {}, {}, {}};
  for (int i = 0; i < 8 * 8 * high; ++i) {
    const Vec3d at{0.1 * (i % 8), 0.1 * (i / 8 % 8), 0.1 * (i / 64)};
    group.spheres.push_back({vec_cast<float>(at), 0.05F, 0});
  }
  return group;
}

Scene images_of(const Group& group, int count) {
  Scene scene;
  scene.materials = {{"", Matte{}}};
  scene.groups = {group};
  for (int i = 0; i < count * count * count; ++i) {
    const Vec3d at{0.8 * (i % count), 0.8 * (i / count % count), 0.8 * (i / count / count)};
    scene.instances.push_back({0, vec_cast<float>(at), {}, 1, {}});
  }
  return scene;
}

/// Turned, of all sizes, within each other, and beside spheres that are in no group.
Scene mixed(std::uint64_t seed) {
  CaseRandom random(seed);
  Scene scene;
  scene.materials = {{"", Matte{}}};
  scene.groups = {cloud(random, 200), grid(2), {"pair", cloud(random, 1).spheres, {}, {}}};
  for (const std::uint32_t inner : {0U, 1U})
    scene.groups[2].instances.push_back(
        {inner, random_vector(random, 1), random_vector(random, 180), 0.5F, {}});
  scene.spheres = cloud(random, static_cast<int>(seed % 3) * 20).spheres;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto scale = static_cast<float>(random.decade(-2, 0.5));
    const double far = seed % 2 == 0 ? 3 : 3e5;
    scene.instances.push_back(
        {i % 3, random_vector(random, far), random_vector(random, 180), scale, {}});
  }
  return scene;
}

void expect_the_same(const Scene& scene) {
  Scene flat = scene;
  expand_instances(flat);
  const SphereBounds found = bounds_of(scene), expected = bounds_of(flat);
  EXPECT_TRUE(found.low == expected.low && found.high == expected.high);
  const Camera a = default_camera(scene, 64, 48), b = default_camera(flat, 64, 48);
  const CameraView seen = build_camera(a, 64, 48), right = build_camera(b, 64, 48);
  EXPECT_TRUE(seen.eye == right.eye && seen.forward == right.forward && seen.up == right.up &&
              seen.right == right.right);
}

TEST(ShownExtremes, FittedCameraMatchesTheExpandedScene) {
  CaseRandom random(4);
  std::vector<Scene> scenes{images_of(cloud(random, 300), 3), images_of(grid(8), 3),
                            images_of(grid(1), 2)};
  for (std::uint64_t seed = 0; seed < 12; ++seed) scenes.push_back(mixed(seed));
  for (Scene& scene : scenes) {
    for (const bool orthographic : {false, true}) {
      scene.fit.type = orthographic ? FittedCamera::orthographic : FittedCamera::pinhole;
      scene.fit.direction = std::nullopt;
      expect_the_same(scene);
      scene.fit.direction = random_vector(random, 1);
      expect_the_same(scene);
    }
  }
}

TEST(ShownExtremes, FewSpheresAreLookedAt) {
  CaseRandom random(5);
  Scene scene = images_of(cloud(random, 2000), 8);
  const ShownExtremes extremes(scene, serial_for);
  std::size_t visited = 0;
  const auto count = [&visited](SphereRun run) { visited += run.size(); };
  extremes.runs({{{0, 0, 0}, 1}, {{1, 0, 0}, 0}, {{0, 0.6, -0.8}, 1}})(count);
  EXPECT_GE(visited, 3U);
  EXPECT_LE(visited, 200U);  // of a million
  scene.instances.clear();
  const ShownExtremes none(scene, serial_for);
  visited = 0;
  none.runs({{{0, 0, 0}, 1}, {{1, 0, 0}, 0}})(count);
  EXPECT_EQ(visited, 0U);
}

}  // namespace
}  // namespace boule::test
