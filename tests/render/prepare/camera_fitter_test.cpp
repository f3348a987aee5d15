#include "render/prepare/camera_fitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "render/prepare/default_camera.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

struct Size {
  int width, height;
};
constexpr Size sizes[] = {{64, 64}, {96, 32}, {20, 90}};

/// The free space at the edges of a picture, from the middle (1) to the edge (0) and beyond
/// (negative): at the left or right, and above or below, where it is narrowest.
struct Room {
  double left = 1, right = 1, below = 1, above = 1;
};

/// How far the outline of a sphere reaches on an axis of a pinhole's picture, towards + and -: the
/// tangents of the angle of its centre, plus and minus that of its radius.
struct Reach {
  double low, high;
};

Reach pinhole_reach(double across, double depth, double radius) {
  const double middle = std::atan2(across, depth);
  const double angular_radius = std::asin(radius / std::hypot(across, depth));
  return {std::tan(middle - angular_radius), std::tan(middle + angular_radius)};
}

/// Measured by the camera's view, whose axes are as long as half the film, another way than the
/// fitter's: with angles.
Room room_of(const std::vector<Sphere>& spheres, const Camera& camera, Size size) {
  EXPECT_FALSE(find_problem(camera));
  const CameraView view = build_camera(camera, size.width, size.height);
  const bool flat = std::holds_alternative<OrthographicCamera>(camera);
  const auto reach = [&](const Sphere& s, const Vec3d& axis) {
    const Vec3d way = vec_cast<double>(s.center) - view.eye;
    const double across = dot(way, normalize(axis)), radius = double{s.radius};
    const Reach all = flat ? Reach{across - radius, across + radius}
                           : pinhole_reach(across, dot(way, view.forward), radius);
    return Reach{all.low / length(axis), all.high / length(axis)};
  };
  Room room;
  for (const Sphere& s : spheres) {
    const Reach x = reach(s, view.right), y = reach(s, view.up);
    room.left = std::min(room.left, 1 + x.low);
    room.right = std::min(room.right, 1 - x.high);
    room.below = std::min(room.below, 1 + y.low);
    room.above = std::min(room.above, 1 - y.high);
  }
  return room;
}

std::vector<Sphere> cloud(std::uint64_t seed, int count) {
  CaseRandom random(seed);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const Vec3d center = random.direction() * random.uniform(0, 10);
    spheres.push_back({vec_cast<float>(center), static_cast<float>(random.uniform(0.1, 2)), 0});
  }
  return spheres;
}

Camera fitted(const CameraFit& fit, const std::vector<Sphere>& spheres, Size size) {
  Scene scene;
  scene.spheres = spheres;
  scene.fit = fit;
  return default_camera(scene, size.width, size.height);
}

const CameraFit fits[] = {
    {},
    {.direction = Vec3f{0, 0, -3}, .fov = 20, .margin = 0},
    {.direction = Vec3f{1, 2, 3}, .up = Vec3f{0, 0, 1}, .fov = 100, .fov_axis = FovAxis::max},
    {.type = FittedCamera::orthographic},
    {.type = FittedCamera::orthographic, .direction = Vec3f{-1, 1, 0}, .margin = 0.2F},
};

TEST(CameraFitter, LeavesTheMarginOnTheTighterAxis) {
  for (const CameraFit& fit : fits) {
    for (const Size size : sizes) {
      for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const auto spheres = cloud(seed, 50);
        const Room room = room_of(spheres, fitted(fit, spheres, size), size);
        // A margin is a share of the side, and the side is 2 here. The camera is rounded to float.
        const double margin = 2 * double{fit.margin}, rounding = 1e-4;
        const double least = std::min({room.left, room.right, room.below, room.above});
        EXPECT_GE(least, margin);
        EXPECT_NEAR(least, margin, rounding);
        const bool x_is_full =
            std::fabs(room.left - margin) < rounding && std::fabs(room.right - margin) < rounding;
        const bool y_is_full =
            std::fabs(room.below - margin) < rounding && std::fabs(room.above - margin) < rounding;
        EXPECT_TRUE(x_is_full || y_is_full);
      }
    }
  }
}

TEST(CameraFitter, LeavesRoomAtTheRight) {
  for (CameraFit fit : fits) {
    if (fit.margin > 0.1F) fit.margin = 0.1F;
    fit.room = 0.25F;
    for (const Size size : sizes) {
      const auto spheres = cloud(7, 50);
      const Room room = room_of(spheres, fitted(fit, spheres, size), size);
      const double margin = 2 * double{fit.margin}, right = margin + 0.5, rounding = 1e-4;
      EXPECT_GE(room.left, margin);
      EXPECT_GE(room.right, right);
      const bool x_is_full = room.left < margin + rounding && room.right < right + rounding;
      const bool y_is_full = room.below < margin + rounding && room.above < margin + rounding;
      EXPECT_TRUE(x_is_full || y_is_full);
    }
  }
}

TEST(CameraFitter, RollTurnsThePicture) {
  const std::vector<Sphere> spheres = cloud(3, 10);
  const CameraFit fit{.direction = Vec3f{0, 0, -1}, .up = Vec3f{0, 1, 0}};
  for (const auto& [degrees, up] : {std::pair{0.0F, Vec3d{0, 1, 0}},
                                    {90.0F, Vec3d{1, 0, 0}},
                                    {-90.0F, Vec3d{-1, 0, 0}},
                                    {180.0F, Vec3d{0, -1, 0}}}) {
    CameraFit rolled = fit;
    rolled.roll = degrees;
    const View view = default_view(rolled, spheres, {});
    EXPECT_EQ(view.direction, (Vec3d{0, 0, -1}));
    EXPECT_LT(length(view.up - up), 1e-15) << degrees;
  }
}

TEST(CameraFitter, FitsDistantHugeAndSingleSpheres) {
  const std::vector<Sphere> one{{{0, 0, 0}, 1, 0}};
  const std::vector<Sphere> far_off{{{1e5f, -3e4f, 20}, 3, 0}, {{1e5f + 9, -3e4f, 20}, 1, 0}};
  const std::vector<Sphere> large{{{0, 0, 0}, 1e9f, 0}, {{3e9f, 0, 0}, 1, 0}};
  const std::vector<Sphere> a_point{{{1, 2, 3}, 0, 0}};
  for (const auto* spheres : {&one, &far_off, &large, &a_point}) {
    for (const Size size : sizes) {
      const Room room = room_of(*spheres, fitted({.margin = 0}, *spheres, size), size);
      EXPECT_GE(std::min({room.left, room.right, room.below, room.above}), 0);
    }
  }
}

TEST(CameraFitter, FitsAllSpheresInAnyOrder) {
  const auto first = cloud(4, 20), second = cloud(5, 20);
  const CameraFit fit;
  const View view = default_view(fit, first, {});
  CameraFitter forwards(fit, view, 64, 64), backwards(fit, view, 64, 64);
  forwards.add(first);
  forwards.add(second);
  backwards.add(second);
  backwards.add(first);
  const auto a = std::get<PinholeCamera>(forwards.camera());
  const auto b = std::get<PinholeCamera>(backwards.camera());
  EXPECT_EQ(a.pose.eye, b.pose.eye);
  EXPECT_EQ(a.pose.look_at, b.pose.look_at);
  for (const auto* spheres : {&first, &second}) {
    const Room room = room_of(*spheres, a, {64, 64});
    EXPECT_GE(std::min({room.left, room.right, room.below, room.above}), 0.1);
  }
}

/// The direction of a scene's default view.
Vec3d looked_along(const std::vector<Sphere>& spheres, const CameraFit& fit = {},
                   const std::vector<Plane>& planes = {}) {
  return default_view(fit, spheres, planes).direction;
}

std::vector<Sphere> row(const Vec3f& step) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 10; ++i) spheres.push_back({step * static_cast<float>(i), 1, 0});
  return spheres;
}

TEST(DefaultView, LooksAcrossRowsAnywhere) {
  for (const Vec3f& step : {Vec3f{2, 0, 0}, Vec3f{0, 2, 0}, Vec3f{0, 0, 2}}) {
    const double along = dot(looked_along(row(step)), normalize(vec_cast<double>(step)));
    EXPECT_LT(std::fabs(along), 0.4) << step.x << step.y << step.z;
  }
}

TEST(DefaultView, IsHigherUpWhereSpheresLieFlat) {
  std::vector<Sphere> sheet, cube;
  for (int i = 0; i < 100; ++i) sheet.push_back({{float(i % 10), 0, float(i / 10)}, 0.5f, 0});
  for (int i = 0; i < 8; ++i)
    cube.push_back({{float(i & 1), float(i / 2 & 1), float(i / 4)}, 1, 0});
  EXPECT_LT(looked_along(sheet).y, -0.6);
  EXPECT_GT(looked_along(cube).y, -0.4);
  EXPECT_LT(looked_along(cube).y, -0.2);
}

TEST(DefaultView, OfASheetIsFaceOn) {
  const auto sheet = [](const Vec3f& a, const Vec3f& b, const Vec3f& bend) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 50; ++i) {
      const auto u = static_cast<float>(i % 10), v = static_cast<float>(i / 10);
      spheres.push_back({a * u + b * (2 * v) + bend * (u * u), 0.5F});
    }
    return spheres;
  };
  const Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, none{};
  const CameraFit y_up{}, z_up{.up = z};
  // As a map: x to the right and y upward.
  const View map = default_view(z_up, sheet(x, y, none), {});
  EXPECT_EQ(map.direction, (Vec3d{0, 0, -1}));
  EXPECT_EQ(map.up, (Vec3d{0, 1, 0}));
  EXPECT_EQ(default_view(y_up, sheet(x, y, none), {}).direction, (Vec3d{0, 0, -1}));
  EXPECT_EQ(default_view(y_up, sheet(x, z, none), {}).direction, (Vec3d{0, -1, 0}));
  EXPECT_EQ(default_view(z_up, sheet(x, z, none), {}).direction, (Vec3d{0, 1, 0}));
  EXPECT_EQ(default_view(z_up, sheet(y, z, none), {}).direction, (Vec3d{-1, 0, 0}));
  // Neither one that is bent, nor one on a floor, nor a row.
  const std::vector<Plane> floor{{{0, 0, -0.5F}, z, 0}};
  EXPECT_GT(default_view(z_up, sheet(x, y, z * 0.01F), {}).direction.y, 0.1);
  EXPECT_EQ(default_view(z_up, sheet(x, y, none), floor).up, (Vec3d{0, 0, 1}));
  EXPECT_LT(default_view(z_up, sheet(x, none, none), {}).direction.z, -0.1);
  EXPECT_EQ(default_view(z_up, sheet(x, none, none), {}).up, (Vec3d{0, 0, 1}));
}

TEST(DefaultView, UpIsGivenOrTheFloorsNormal) {
  const auto spheres = cloud(6, 20);
  EXPECT_EQ(default_view({}, spheres, {}).up, (Vec3d{0, 1, 0}));
  EXPECT_EQ(default_view({}, spheres, {{{0, 0, 0}, {0, 0, 2}, 0}}).up, (Vec3d{0, 0, 1}));
  EXPECT_EQ(default_view({}, spheres, {{{0, 0, 0}, {0, 0, -2}, 0}}).up, (Vec3d{0, 0, -1}));
  EXPECT_EQ(default_view({}, spheres, {{{0, 0, 0}, {1, 0, 0}, 0}}).up, (Vec3d{0, 1, 0}));
  const CameraFit z_up{.up = Vec3f{0, 0, 5}};
  EXPECT_EQ(default_view(z_up, spheres, {}).up, (Vec3d{0, 0, 1}));
  EXPECT_LT(looked_along(spheres, z_up).z, -0.2);  // from above
  EXPECT_GT(looked_along(spheres, z_up).y, 0.5);   // from the front, which is -y where z is up
}

TEST(DefaultView, SeenFromAboveFartherIsHigher) {
  const View map = default_view({.direction = Vec3f{0, -1, 0}}, cloud(7, 20), {});
  EXPECT_EQ(map.up, (Vec3d{0, 0, -1}));
}

TEST(CameraFit, ErrorsCoverFieldsAndTheWhole) {
  EXPECT_FALSE(find_problem(CameraFit{}));
  EXPECT_EQ(find_problem(CameraFit{.direction = Vec3f{}})->field, "direction");
  EXPECT_EQ(find_problem(CameraFit{.up = Vec3f{}})->field, "up");
  EXPECT_EQ(find_problem(CameraFit{.fov = 180})->field, "fov");
  EXPECT_EQ(find_problem(CameraFit{.margin = 0.5F})->field, "margin");
  EXPECT_EQ(find_problem(CameraFit{.margin = -0.1F})->field, "margin");
  EXPECT_EQ(find_problem(CameraFit{.room = 0.5F})->field, "room");
  EXPECT_EQ(find_problem(CameraFit{.margin = 0.3F, .room = 0.4F})->field, "room");
  const CameraFit along{.direction = Vec3f{0, 2, 0}, .up = Vec3f{0, -1, 0}};
  EXPECT_EQ(find_problem(along)->field, "up");
}

}  // namespace
}  // namespace boule::test
