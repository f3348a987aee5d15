#include "core/scene/principal_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/geometry.h"
#include "core/math/similarity.h"

namespace boule {
namespace {

/// Centres on a lattice within a box of these half sides, turned and moved.
Scene block(const Vec3d& half, const Vec3d& degrees = {}, const Vec3d& shift = {}) {
  const Similarity turn = rotation(degrees);
  Scene scene;
  for (double x = -half.x; x <= half.x; ++x) {
    for (double y = -half.y; y <= half.y; ++y) {
      for (double z = -half.z; z <= half.z; ++z)
        scene.spheres.push_back({vec_cast<float>(turn.rotate({x, y, z}) + shift), 0.5F, {}});
    }
  }
  return scene;
}

void expect_near(const Vec3f& v, const Vec3d& wanted) {
  EXPECT_LT(length(vec_cast<double>(v) - wanted), 1e-3) << v.x << " " << v.y << " " << v.z;
}

TEST(PrincipalPose, LongestAxisIsHorizontal) {
  struct Case {
    Vec3d half, direction, up;
  };
  for (const Case& one :
       {Case{{9, 5, 2}, {0, 0, -1}, {0, 1, 0}}, Case{{2, 5, 9}, {1, 0, 0}, {0, 1, 0}},
        Case{{5, 9, 2}, {0, 0, 1}, {1, 0, 0}}, Case{{9, 2, 5}, {0, 1, 0}, {0, 0, 1}}}) {
    const auto pose = principal_pose(block(one.half));
    ASSERT_TRUE(pose);
    expect_near(pose->direction, one.direction);
    expect_near(pose->up, one.up);
  }
}

// The axes of a block that was turned are those of its matrix, whatever the signs.
TEST(PrincipalPose, FollowsTheSpheres) {
  const Vec3d degrees{20, 50, -70};
  const Similarity turn = rotation(degrees);
  const auto pose = principal_pose(block({9, 5, 2}, degrees, {100, -7, 3}));
  ASSERT_TRUE(pose);
  const auto along = [&](const Vec3f& v, const Vec3d& axis) {
    return std::fabs(dot(vec_cast<double>(v), turn.rotate(axis)));
  };
  EXPECT_GT(along(pose->direction, {0, 0, 1}), 0.999999);
  EXPECT_GT(along(pose->up, {0, 1, 0}), 0.999999);
}

TEST(PrincipalPose, OrderAndThreadsDoNotMatter) {
  Scene scene = block({70, 40, 10}, {1, 2, 3});
  ASSERT_GT(scene.spheres.size(), 100000U);
  const auto pose = principal_pose(scene);
  const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t)>& f) {
    for (std::size_t i = count; i > 0; --i) f(i - 1);
  };
  const auto other = principal_pose(scene, backwards);
  std::reverse(scene.spheres.begin(), scene.spheres.end());
  const auto reversed = principal_pose(scene);
  ASSERT_TRUE(pose && other && reversed);
  EXPECT_EQ(pose->direction, other->direction);
  EXPECT_EQ(pose->up, other->up);
  EXPECT_EQ(pose->direction, reversed->direction);
  EXPECT_EQ(pose->up, reversed->up);
}

TEST(PrincipalPose, EqualAxesAreMostUpright) {
  const auto rod = principal_pose(block({9, 2, 2}));
  ASSERT_TRUE(rod);
  expect_near(rod->up, {0, 1, 0});
  expect_near(rod->direction, {0, 0, -1});
  const auto disc = principal_pose(block({9, 9, 1}));
  ASSERT_TRUE(disc);
  expect_near(disc->up, {0, 1, 0});
  EXPECT_NEAR(std::fabs(disc->direction.z), 1, 1e-3);
}

TEST(PrincipalPose, RoundThingsHaveNone) {
  EXPECT_FALSE(principal_pose(block({4, 4, 4})));
  EXPECT_FALSE(principal_pose(block({0, 0, 0})));
  EXPECT_FALSE(principal_pose(Scene{}));
  EXPECT_TRUE(principal_pose(block({1, 0, 0})));
}

TEST(PrincipalPose, InstancesCount) {
  Scene scene;
  scene.groups.emplace_back();
  scene.groups.back().spheres.push_back({{0, 0, 0}, 1, {}});
  for (const float x : {-3.0F, 0.0F, 3.0F}) scene.instances.push_back({.translate = {0, 0, x}});
  const auto pose = principal_pose(scene);
  ASSERT_TRUE(pose);
  const Vec3d right = cross(vec_cast<double>(pose->direction), vec_cast<double>(pose->up));
  EXPECT_NEAR(right.z, 1, 1e-6);
}

TEST(PrincipalPose, SettlesTheFit) {
  Scene scene = block({9, 5, 2});
  scene.fit.pose = FittedPose::principal;
  EXPECT_FALSE(find_problem(scene.fit));
  const CameraFit fit = settled_fit(scene);
  EXPECT_FALSE(fit.pose);
  ASSERT_TRUE(fit.direction && fit.up);
  EXPECT_FALSE(find_problem(fit));
  Scene round = block({4, 4, 4});
  round.fit.pose = FittedPose::principal;
  EXPECT_EQ(settled_fit(round), CameraFit{});
}

}  // namespace
}  // namespace boule
