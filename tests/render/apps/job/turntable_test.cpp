// A scene that turns before its camera.
#include "render/apps/job/turntable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/geometry.h"
#include "core/math/similarity.h"

namespace boule {
namespace {

/// A long body, which sticks out far when it turns.
Scene long_body() {
  Scene scene;
  for (const Vec3f& at : {Vec3f{-9, 0, 0}, Vec3f{9, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, -1, 2}})
    scene.spheres.push_back({at, 0.5F, {}});
  return scene;
}

/// The distance of the outermost outline from the edge of the picture, as a share of its half:
/// below 0 it is cut off.
double least_room(const Scene& scene, const PinholeCamera& camera, double aspect) {
  const Vec3d eye = vec_cast<double>(camera.pose.eye);
  const Vec3d forward = normalize(vec_cast<double>(camera.pose.look_at) - eye);
  const Vec3d right = normalize(cross(forward, vec_cast<double>(camera.pose.up)));
  const Vec3d up = cross(right, forward);
  const double half = std::tan(static_cast<double>(camera.fov) * std::acos(-1.0) / 360);
  double room = 1;
  for (const Sphere& sphere : scene.spheres) {
    const Vec3d from = vec_cast<double>(sphere.center) - eye;
    const auto angle_of = [&](const Vec3d& across) {
      return std::fabs(std::atan2(dot(from, across), dot(from, forward))) +
             std::asin(static_cast<double>(sphere.radius) /
                       std::hypot(dot(from, across), dot(from, forward)));
    };
    room = std::min(room, 1 - std::tan(angle_of(right)) / (half * aspect));
    room = std::min(room, 1 - std::tan(angle_of(up)) / half);
  }
  return room;
}

TEST(Turntable, NothingLeavesThePicture) {
  const Scene scene = long_body();
  const auto table = Turntable::of(scene, {400, 300});
  ASSERT_TRUE(table.ok());
  double least = 1;
  for (int step = 0; step < 72; ++step) {
    const Camera camera = table.value().at(step * 5);
    const double room = least_room(scene, std::get<PinholeCamera>(camera), 4.0 / 3);
    EXPECT_GE(room, 0.1 - 1e-4) << step;  // the margin is 0.05 of the whole side
    least = std::min(least, room);
  }
  EXPECT_LT(least, 0.15);  // and it is not farther away than it must be
}

TEST(Turntable, TurnsCounterClockwiseFromAbove) {
  Scene scene = long_body();
  scene.camera = PinholeCamera{{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}}, 40, FovAxis::y};
  const auto table = Turntable::of(scene, {400, 300});
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(std::get<PinholeCamera>(table.value().at(0)).pose.eye, (Vec3f{0, 0, 10}));
  // What was at the right, +x, comes to the back: the camera goes to its left.
  const auto quarter = std::get<PinholeCamera>(table.value().at(90));
  EXPECT_EQ(quarter.pose.eye, (Vec3f{-10, 0, 0}));
  EXPECT_EQ(quarter.pose.look_at, (Vec3f{0, 0, 0}));
  EXPECT_EQ(quarter.pose.up, (Vec3f{0, 1, 0}));
}

TEST(Turntable, RollDoesNotTiltTheAxis) {
  Scene scene = long_body();
  const auto upright = Turntable::of(scene, {300, 300});
  scene.fit.roll = 90;
  const auto rolled = Turntable::of(scene, {300, 300});
  ASSERT_TRUE(upright.ok() && rolled.ok());
  const auto way = [](const Turntable& table) {
    const CameraPose pose = std::get<PinholeCamera>(table.at(90)).pose;
    return normalize(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
  };
  EXPECT_LT(length(way(upright.value()) - way(rolled.value())), 1e-4);
}

TEST(Turntable, NeedsSpheresOrACamera) {
  const auto none = Turntable::of(Scene{}, {400, 300});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().key, "--turn");
}

}  // namespace
}  // namespace boule
