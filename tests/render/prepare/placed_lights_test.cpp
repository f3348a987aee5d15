#include "render/prepare/placed_lights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/prepare/prepared_scene.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// Looks along +x from (1, 2, 3), four units far, with z up: its right is -y.
const Camera camera = PinholeCamera{{{1, 2, 3}, {5, 2, 3}, {0, 0, 1}}, 30, FovAxis::x};

TEST(PlacedLights, AreMeasuredByTheCamera) {
  std::vector<Light> lights = {PointLight{{0.5f, 1, 2}, gray(1), Falloff::none, LightFrame::camera},
                               DirectionalLight{{1, 2, -3}, gray(1), LightFrame::camera},
                               SphereLight{{0.5f, 1, -2}, 0.25f, gray(1), LightFrame::camera}};
  ASSERT_TRUE(place_lights(lights, camera));
  EXPECT_EQ(std::get<PointLight>(lights[0]).position, (Vec3f{1 - 8, 2 - 2, 3 + 4}));
  EXPECT_EQ(std::get<DirectionalLight>(lights[1]).direction, (Vec3f{3, -1, 2}));
  EXPECT_EQ(std::get<SphereLight>(lights[2]).center, (Vec3f{1 + 8, 2 - 2, 3 + 4}));
  EXPECT_EQ(std::get<SphereLight>(lights[2]).radius, 1);
  EXPECT_EQ(std::get<SphereLight>(lights[2]).relative_to, LightFrame::scene);
}

TEST(PlacedLights, OfTheSceneStayWhereTheyAre) {
  std::vector<Light> lights = {PointLight{{0.5f, 1, 2}}, DirectionalLight{{1, 2, -3}},
                               SphereLight{{0.5f, 1, -2}, 0.25f}};
  ASSERT_TRUE(place_lights(lights, camera));
  EXPECT_EQ(std::get<PointLight>(lights[0]).position, (Vec3f{0.5f, 1, 2}));
  EXPECT_EQ(std::get<DirectionalLight>(lights[1]).direction, (Vec3f{1, 2, -3}));
  EXPECT_EQ(std::get<SphereLight>(lights[2]).center, (Vec3f{0.5f, 1, -2}));
  EXPECT_EQ(std::get<SphereLight>(lights[2]).radius, 0.25f);
}

TEST(PlacedLights, ThatFloatsDoNotHoldAreRefused) {
  Scene scene = mixed_scene(8, 8);
  scene.lights = {PointLight{}, SphereLight{{3e38f, 0, 0}, 1, gray(1), LightFrame::camera}};
  const auto prepared = prepare(scene, 8, 8);
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().key, "light[1].center");
}

TEST(PlacedLights, LightPicturesLikeOthers) {
  Scene scene = mixed_scene(24, 20);
  scene.camera = PinholeCamera{{{0, 1, 6}, {0, 1, 0}, {0, 1, 0}}, 40, FovAxis::x};
  for (const Method method : {Method::whitted, Method::path}) {
    scene.render.method = method;
    scene.lights = {SphereLight{{-3, 4, 3}, 1.5f, gray(9)}, PointLight{{3, 1, 6}}};
    const Image expected = render(scene);
    scene.lights = {SphereLight{{-0.5f, 0.5f, -0.5f}, 0.25f, gray(9), LightFrame::camera},
                    PointLight{{0.5f, 0, 0}, gray(1), Falloff::none, LightFrame::camera}};
    EXPECT_EQ(differing_pixels(render(scene), expected), 0);
  }
}

}  // namespace
}  // namespace boule::test
