#include "core/optics/camera_builder.h"
#include "core/scene/camera.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

double film(const RasterToFilm& map, double raster) {
  return (raster * map.scale + map.offset) / map.extent;
}

/// tan of half a field of view in degrees.
double half_tangent(double fov) { return elementary::tan_acute(fov * (elementary::pi / 360)); }

PinholeCamera pinhole(float fov, FovAxis axis) {
  return {{{0, 0, 0}, {0, 0, -5}, {0, 1, 0}}, fov, axis};
}

struct Films {
  RasterToFilm x, y;
};
Films films(int width, int height) {
  const CameraView view = build_camera(pinhole(45, FovAxis::x), width, height);
  return {view.film_x, view.film_y};
}

// Lecture "Pixel centres": those of a 4x4 image.
TEST(RasterToFilm, HasTheLecturesPixelCentres) {
  const auto [x, y] = films(4, 4);
  EXPECT_EQ(film(x, 0.5), -0.75);  // first column, last row
  EXPECT_EQ(film(y, 3.5), -0.75);
  EXPECT_EQ(film(x, 1.5), -0.25);  // second column, second row
  EXPECT_EQ(film(y, 1.5), 0.25);
}

TEST(RasterToFilm, PutsRowZeroOnTop) {
  const auto [x, y] = films(1280, 720);
  EXPECT_EQ(film(y, 0), 1);
  EXPECT_EQ(film(y, 720), -1);
  EXPECT_EQ(film(x, 0), -1);
  EXPECT_EQ(film(x, 1280), 1);
  EXPECT_EQ(film(films(3, 1).x, 1.5), 0);
  EXPECT_EQ(film(films(3, 1).y, 0.5), 0);
}

TEST(CameraView, IsRightHanded) {
  const CameraView view = build_camera(pinhole(90, FovAxis::x), 4, 4);
  const double t = half_tangent(90);
  EXPECT_EQ(view.eye, (Vec3d{0, 0, 0}));
  EXPECT_EQ(view.forward, (Vec3d{0, 0, -1}));
  EXPECT_EQ(view.right, (Vec3d{t, 0, 0}));
  EXPECT_EQ(view.up, (Vec3d{0, t, 0}));
  EXPECT_EQ(view.kind, CameraKind::pinhole);
  EXPECT_NEAR(t, 1, 0x1p-52);
}

TEST(CameraView, CarriesTheFilm) {
  const CameraView view = build_camera(pinhole(40, FovAxis::x), 1280, 720);
  EXPECT_EQ(film(view.film_x, 0), -1);
  EXPECT_EQ(film(view.film_x, 1280), 1);
  EXPECT_EQ(film(view.film_y, 0), 1);
  EXPECT_EQ(film(view.film_y, 720), -1);
}

TEST(CameraView, IsOrthogonalForAnyPose) {
  PinholeCamera camera = pinhole(60, FovAxis::x);
  camera.pose = {{1, 2, 3}, {-4, 0.5f, 7}, {0.3f, 2, -0.1f}};
  const CameraView view = build_camera(camera, 100, 100);
  const double half = half_tangent(60);
  EXPECT_NEAR(length(view.forward), 1, 1e-15);  // some roundings of 2^-53
  EXPECT_NEAR(length(view.right), half, 1e-15);
  EXPECT_NEAR(length(view.up), half, 1e-15);
  EXPECT_NEAR(dot(view.forward, view.right), 0, 1e-15);
  EXPECT_NEAR(dot(view.forward, view.up), 0, 1e-15);
  EXPECT_NEAR(dot(view.right, view.up), 0, 1e-15);
  EXPECT_GT(dot(view.up, vec_cast<double>(camera.pose.up)), 0);
  const Vec3d to_target = vec_cast<double>(camera.pose.look_at) - view.eye;
  EXPECT_NEAR(dot(view.forward, to_target), length(to_target), 1e-14);
}

TEST(CameraView, LengthsOfPoseVectorsDoNotMatter) {
  PinholeCamera near = pinhole(45, FovAxis::x), far = near;
  far.pose.look_at = {0, 0, -4096};
  far.pose.up = {0, 64, 0};
  const CameraView a = build_camera(near, 8, 8), b = build_camera(far, 8, 8);
  EXPECT_EQ(a.forward, b.forward);
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.up, b.up);
}

struct FovCase {
  FovAxis axis;
  int width, height;
  double half_width, half_height;  ///< in units of tan(fov / 2)
};

TEST(CameraView, FovSpansTheAxisItNames) {
  const double t = half_tangent(45);
  const FovCase cases[] = {
      {FovAxis::x, 400, 200, 1, 0.5},   {FovAxis::x, 200, 400, 1, 2},
      {FovAxis::y, 400, 200, 2, 1},     {FovAxis::y, 200, 400, 0.5, 1},
      {FovAxis::max, 400, 200, 1, 0.5}, {FovAxis::max, 200, 400, 0.5, 1},
      {FovAxis::max, 300, 300, 1, 1},
  };
  for (const FovCase& c : cases) {
    const CameraView view = build_camera(pinhole(45, c.axis), c.width, c.height);
    EXPECT_EQ(view.right.x, t * c.half_width) << c.width << "x" << c.height;
    EXPECT_EQ(view.up.y, t * c.half_height) << c.width << "x" << c.height;
  }
}

TEST(CameraView, PixelsAreSquare) {
  for (const FovAxis axis : {FovAxis::x, FovAxis::y, FovAxis::max}) {
    const CameraView view = build_camera(pinhole(70, axis), 1920, 1080);
    EXPECT_NEAR(length(view.right) / 1920, length(view.up) / 1080, 1e-18);
  }
}

TEST(CameraView, OrthographicFilmHasTheStatedHeight) {
  const OrthographicCamera camera{{{1, 2, 3}, {1, 2, 0}, {0, 1, 0}}, 6};
  const CameraView view = build_camera(camera, 400, 200);
  EXPECT_EQ(view.kind, CameraKind::orthographic);
  EXPECT_EQ(view.eye, (Vec3d{1, 2, 3}));
  EXPECT_EQ(view.forward, (Vec3d{0, 0, -1}));
  EXPECT_EQ(view.right, (Vec3d{6, 0, 0}));
  EXPECT_EQ(view.up, (Vec3d{0, 3, 0}));
}

}  // namespace
}  // namespace boule
