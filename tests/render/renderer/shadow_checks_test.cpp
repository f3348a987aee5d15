// Which pixels are lit and which are in shadow, compared with a tracer in long double.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/render/renderer/checked_picture.h"

namespace boule::test {
namespace {

class ShadowChecks : public OnEachIsa {};

/// Unit balls on a ground sphere whose top is the origin.
Scene ground_scene(double radius) {
  Scene scene = matte_scene(192, 144);
  scene.camera = pinhole({0.3f, 3, 9}, {0, 0.4f, 0}, 55);
  scene.spheres = {{{0, static_cast<float>(-radius), 0}, static_cast<float>(radius), 0}};
  for (const auto& [x, z] : {std::pair{0.0, 0.0},
                             {-2.5, 1.0},
                             {2.25, 1.5},
                             {-3.5, -4.0},
                             {4.0, -5.0},
                             {0.5, -12.0},
                             {-1.0, 4.0}}) {
    const double y = std::sqrt((radius + 1) * (radius + 1) - x * x - z * z) - radius;
    scene.spheres.push_back(
        {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}, 1, 0});
  }
  return scene;
}

// An offset such as t > 1e-6 makes 5 to 35 % false shadow here (docs/numerics.md).
TEST_P(ShadowChecks, BallsOnAGroundSphere) {
  for (const double radius : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    for (const Vec3f& light : {Vec3f{4, 6, 3}, {-7, 1.5f, 5}, {2, 2.5f, -9}}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", light at height " << light.y);
      Scene scene = ground_scene(radius);
      light_from(scene, light);
      const Verdict verdict = judge(scene, render_checked(scene, GetParam()));
      expect_right(verdict);
      EXPECT_GT(verdict.lit, 1000) << verdict;
      EXPECT_GT(verdict.dark, 1000) << verdict;
    }
  }
}

/// A ball that touches a plane at the origin, seen along the ground. The lower the eye, the closer
/// to the contact it sees.
Scene resting_scene(float eye_height, float fov) {
  Scene scene = matte_scene(128, 128);
  scene.camera = pinhole({0, eye_height, 4}, {0, 0, 0}, fov);
  scene.spheres = {{{0, 1, 0}, 1, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
  return scene;
}

struct CloseUp {
  float eye_height, fov;
};
constexpr CloseUp close_ups[] = {
    {0.5f, 40}, {0.05f, 5}, {0.005f, 0.5f}, {5e-4f, 0.05f}, {5e-5f, 5e-3f}};

TEST_P(ShadowChecks, AroundABallOnAPlane) {
  for (const CloseUp& view : close_ups) {
    const Vec3f lights[] = {{3, 4, 2}, {0.5f, view.eye_height, 4}, {1, -2, 3}, {-2, 0.01f, 0.5f}};
    for (const Vec3f& light : lights) {
      SCOPED_TRACE(testing::Message() << "eye at " << view.eye_height << ", light " << light.x
                                      << " " << light.y << " " << light.z);
      Scene scene = resting_scene(view.eye_height, view.fov);
      light_from(scene, light);
      const Verdict verdict = judge(scene, render_checked(scene, GetParam()));
      expect_right(verdict);
      EXPECT_EQ(verdict.lit == 0, light.y < 0) << verdict;  // from below nothing is lit
    }
  }
}

// A ray leaves its surface by id, so it does meet a copy of the surface at the same position.
TEST_P(ShadowChecks, TwinsInTheSamePlace) {
  for (const CloseUp& view : close_ups) {
    Scene scene = resting_scene(view.eye_height, view.fov);
    light_from(scene, {0.5f, 0.4f, 4});
    Scene twins = scene;
    twins.spheres.push_back(scene.spheres.front());
    twins.planes.push_back(scene.planes.front());
    CheckedPicture picture = render_checked(twins, GetParam());
    for (std::uint32_t& id : picture.ids) id = id == 2 ? 1 : id;  // the plane
    expect_right(judge(scene, picture));
  }
}

/// Coordinates that are multiples of 1/16 stay exact when they are moved by 1e6.
Scene scene_of_sixteenths() {
  Scene scene = matte_scene(192, 144);
  scene.camera = pinhole({0.25f, 3, 9}, {0, 0.5f, 0}, 55);
  light_from(scene, {4, 6, 3});
  scene.spheres = {{{0, 1, 0}, 1, 0},      {{-2.5f, 1, 1}, 1, 0}, {{2.25f, 0.75f, 1.5f}, 0.75f, 0},
                   {{-3.5f, 2, -4}, 2, 0}, {{0.5f, 3, 0}, 1, 0},  {{1, 0.25f, 3}, 0.25f, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0}, {{0, 0, -8}, {0.25f, 0, 1}, 0}};
  return scene;
}

TEST_P(ShadowChecks, FarFromTheWorldsOrigin) {
  for (const Vec3f& by : {Vec3f{1e5f, 1e5f, -1e5f}, {1e6f, 0, 0}, {1e6f, -1e6f, 1e6f}}) {
    SCOPED_TRACE(testing::Message() << by.x << " " << by.y << " " << by.z);
    const Scene near_scene = scene_of_sixteenths();
    const Scene scene = moved(near_scene, by);
    ASSERT_EQ(moved(scene, -by).spheres[2].center, near_scene.spheres[2].center);
    const Verdict verdict = judge(scene, render_checked(scene, GetParam()));
    expect_right(verdict);
    EXPECT_GT(verdict.lit, 1000) << verdict;
    EXPECT_GT(verdict.dark, 1000) << verdict;
  }
}

/// Where the light lies on a surface, a shadow ray of slope s ends 4 u s above the surface, and the
/// rounding of its direction moves that by up to u. So the oracle is unsure below s = 1/4.
void expect_right_beside_the_light(const Scene& scene, const std::string& isa) {
  const Vec3f light = light_of(scene);
  SCOPED_TRACE(testing::Message() << "light " << light.x << " " << light.y << " " << light.z);
  const Verdict verdict = judge(scene, render_checked(scene, isa));
  EXPECT_EQ(verdict.wrong_ids, 0) << verdict;
  EXPECT_EQ(verdict.false_shadows, 0) << verdict;
  EXPECT_EQ(verdict.leaks, 0) << verdict;
  EXPECT_GT(verdict.lit, 1000) << verdict;
}

/// Balls and a ceiling above a floor on which the light lies.
Scene floor_scene(const Vec3f& up, const Vec3f& light) {
  Scene scene = matte_scene(128, 96);
  scene.camera = pinhole({0.5f, 6, 12}, {0, 5, 0}, 60);
  light_from(scene, light);
  scene.spheres = {{{0, 4, 0}, 1, 0}, {{-2.5f, 5, 1}, 0.75f, 0}, {{2.5f, 3, -1}, 0.5f, 0}};
  scene.planes = {{{0, 9, 0}, {0, -1, 0}, 0}, {{0, 0, -9}, {0, 0, 1}, 0}, {{0, 0, 0}, up, 0}};
  return scene;
}

TEST_P(ShadowChecks, LightOnAPlane) {
  for (const Vec3f& light : {Vec3f{1, 0, 1}, {-0.7f, 0, 2.3f}, {3.1f, 0, -4}})
    expect_right_beside_the_light(floor_scene({0, 1, 0}, light), GetParam());
  for (const Vec3f& light : {Vec3f{4, -3, 1}, {-4, 3, 2.3f}, {0.5f, -0.375f, -4}, {2, -1.5f, 3}})
    expect_right_beside_the_light(floor_scene({3, 4, 0}, light), GetParam());
}

/// Points whose distance from the origin is a float as well.
constexpr Vec3f whole_lengths[] = {{1, 2, 2}, {2, 3, 6}, {4, 4, 7}, {6, 6, 7}, {9, 8, 12}};

float radius_of(const Vec3f& place) { return static_cast<float>(length(vec_cast<double>(place))); }

TEST_P(ShadowChecks, LightOnASphereFromOutside) {
  for (const Vec3f& light : whole_lengths) {
    Scene scene = matte_scene(128, 96);
    const float r = radius_of(light);
    scene.camera = pinhole({r, 1.5f * r, 5 * r}, {0, r, 0}, 60);
    light_from(scene, light);
    scene.spheres = {
        {light * 1.5f, 0.3f * r, 0}, {{2 * r, r, 0.5f * r}, 0.2f * r, 0}, {{0, 0, 0}, r, 0}};
    scene.planes = {{{0, 2.5f * r, 0}, {0, -1, 0}, 0}, {{0, 0, -2 * r}, {0, 0, 1}, 0}};
    expect_right_beside_the_light(scene, GetParam());
  }
}

TEST_P(ShadowChecks, LightOnASphereFromInside) {
  for (const Vec3f& light : whole_lengths) {
    Scene scene = matte_scene(128, 96);
    const float r = radius_of(light);
    scene.camera = pinhole({0.1f * r, -0.2f * r, 0.15f * r}, {-light.x, 0, light.z}, 100);
    light_from(scene, light);
    scene.spheres = {{{0, 0, 0}, r, 0}, {{-0.4f * r, 0.1f * r, 0.4f * r}, 0.2f * r, 0}};
    expect_right_beside_the_light(scene, GetParam());
  }
}

// Inside of a sphere, its own shell keeps out all light from outside.
TEST_P(ShadowChecks, NoLightEntersAClosedSphere) {
  for (const float r : {1.0f, 1e2f, 1e4f, 1e6f}) {
    for (const float beyond : {1.00001f, 1.1f, 10.0f}) {
      SCOPED_TRACE(testing::Message() << "radius " << r << ", light at " << beyond);
      Scene scene = matte_scene(96, 96);
      scene.camera = pinhole({0.1f * r, -0.2f * r, 0.15f * r}, {0.2f * r, r, 0.3f * r}, 120);
      scene.spheres = {{{0, 0, 0}, r, 0}, {{0.3f * r, 0.5f * r, 0}, 0.2f * r, 0}};
      light_from(scene, {0, beyond * r, 0});
      const Verdict verdict = judge(scene, render_checked(scene, GetParam()));
      expect_right(verdict);
      EXPECT_EQ(verdict.lit, 0) << verdict;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShadowChecks, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
