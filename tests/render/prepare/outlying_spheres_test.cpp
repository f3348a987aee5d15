// Cameras that leave out spheres far from all others.
#include "render/prepare/outlying_spheres.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/prepare/default_camera.h"
#include "tests/support/case_random.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// A ball of small stars around a point.
Scene stars(std::size_t count, const Vec3f& middle = {0, 0, 0}) {
  CaseRandom random(7);
  Scene scene;
  add_material(scene, Matte{});
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f center = vec_cast<float>(random.direction() * random.uniform(0, 10));
    scene.spheres.push_back({middle + center, 0.02f, 0});
  }
  return scene;
}

TEST(OutlyingSpheres, MedianIsThatOfSortedNumbers) {
  for (const std::size_t count : {1u, 2u, 5u, 1000u}) {
    const Scene scene = stars(count, {-3, 1000, 0});
    const auto sorted = [&](float Vec3f::*axis) {
      std::vector<float> all;
      for (const Sphere& s : scene.spheres) all.push_back(s.center.*axis);
      std::sort(all.begin(), all.end());
      return all[(count - 1) / 2];
    };
    const auto median = median_sphere(scene);
    ASSERT_TRUE(median);
    EXPECT_EQ(median->center, (Vec3f{sorted(&Vec3f::x), sorted(&Vec3f::y), sorted(&Vec3f::z)}));
    EXPECT_EQ(median->radius, 0.02f);
  }
  EXPECT_FALSE(median_sphere(Scene{}));
}

TEST(OutlyingSpheres, FewFarOnesAreLeftOut) {
  Scene scene = stars(1000);
  const Camera near = default_camera(scene, 400, 300);
  scene.spheres.push_back({{5000, 0, 0}, 0.02f, 0});
  scene.spheres.insert(scene.spheres.begin(), Sphere{{0, -9000, 0}, 0.02f, 0});
  const auto [camera, leaves_out] = choose_camera(scene, 400, 300);
  EXPECT_TRUE(leaves_out);
  EXPECT_EQ(std::get<PinholeCamera>(camera).pose.eye, std::get<PinholeCamera>(near).pose.eye);
  std::reverse(scene.spheres.begin(), scene.spheres.end());
  const Camera other = default_camera(scene, 400, 300);
  EXPECT_EQ(std::get<PinholeCamera>(camera).pose.eye, std::get<PinholeCamera>(other).pose.eye);
}

TEST(OutlyingSpheres, BoxesLeaveThemOutButNotCapsules) {
  Scene scene = stars(1000);
  scene.capsules.push_back({{0, 20, 0}, {0, 4000, 0}, 1, 0});
  const SphereBounds near = bounds_of(scene);
  EXPECT_EQ(bounds_without_outliers(scene).low, near.low);
  EXPECT_EQ(bounds_without_outliers(scene).high, near.high);
  EXPECT_EQ(near.high.y, 4001);
  scene.spheres.insert(scene.spheres.begin(), Sphere{{0, -9000, 0}, 0.02f, 0});
  EXPECT_LT(bounds_of(scene).low.y, -9000);
  EXPECT_EQ(bounds_without_outliers(scene).low, near.low);
  EXPECT_EQ(bounds_without_outliers(scene).high, near.high);
}

TEST(OutlyingSpheres, StayWhereTheyHideNothing) {
  Scene scene = stars(1000);
  scene.spheres.push_back({{5000, 0, 0}, 0.02f, 0});
  for (Sphere& sphere : scene.spheres) sphere.radius = 60;  // larger than a pixel
  EXPECT_FALSE(choose_camera(scene, 400, 300).leaves_out);
  scene = stars(1000);
  for (int i = 0; i < 20; ++i) scene.spheres.push_back({{5000.0f + i, 0, 0}, 0.02f, 0});
  EXPECT_FALSE(choose_camera(scene, 400, 300).leaves_out) << "2 %";
  scene = stars(1000);
  scene.spheres.push_back({{20, 0, 0}, 0.02f, 0});
  EXPECT_FALSE(choose_camera(scene, 40, 30).leaves_out) << "not much larger without it";
  scene = stars(2);
  scene.spheres[0].center.x = 9000;
  EXPECT_FALSE(choose_camera(scene, 40, 30).leaves_out);
  scene.spheres.assign(500, scene.spheres[0]);  // all alike
  EXPECT_FALSE(choose_camera(scene, 40, 30).leaves_out);
}

}  // namespace
}  // namespace boule::test
