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

// Lecture "Pixel centres": those of a 4x4 image.
TEST(RasterToFilm, HasTheSlidesPixelCentres) {
  const RasterToFilm x = raster_to_film_x(4), y = raster_to_film_y(4);
  EXPECT_EQ(film(x, 0.5), -0.75);  // first column, last row
  EXPECT_EQ(film(y, 3.5), -0.75);
  EXPECT_EQ(film(x, 1.5), -0.25);  // second column, second row
  EXPECT_EQ(film(y, 1.5), 0.25);
}

TEST(RasterToFilm, PutsRowZeroOnTop) {
  EXPECT_EQ(film(raster_to_film_y(720), 0), 1);
  EXPECT_EQ(film(raster_to_film_y(720), 720), -1);
  EXPECT_EQ(film(raster_to_film_x(1280), 0), -1);
  EXPECT_EQ(film(raster_to_film_x(1280), 1280), 1);
  EXPECT_EQ(film(raster_to_film_x(3), 1.5), 0);
  EXPECT_EQ(film(raster_to_film_y(1), 0.5), 0);
}

TEST(CameraBasis, IsRightHanded) {
  const CameraBasis basis = camera_basis(pinhole(90, FovAxis::x), 4, 4);
  const double t = half_tangent(90);
  EXPECT_EQ(basis.eye, (Vec3d{0, 0, 0}));
  EXPECT_EQ(basis.forward, (Vec3d{0, 0, -1}));
  EXPECT_EQ(basis.right, (Vec3d{t, 0, 0}));
  EXPECT_EQ(basis.up, (Vec3d{0, t, 0}));
  EXPECT_EQ(basis.kind, CameraKind::perspective);
  EXPECT_NEAR(t, 1, 0x1p-52);
}

TEST(CameraBasis, CarriesTheFilm) {
  const CameraBasis basis = camera_basis(pinhole(40, FovAxis::x), 1280, 720);
  EXPECT_EQ(film(basis.film_x, 0), -1);
  EXPECT_EQ(film(basis.film_x, 1280), 1);
  EXPECT_EQ(film(basis.film_y, 0), 1);
  EXPECT_EQ(film(basis.film_y, 720), -1);
}

TEST(CameraBasis, IsOrthogonalForAnyPose) {
  PinholeCamera camera = pinhole(60, FovAxis::x);
  camera.pose = {{1, 2, 3}, {-4, 0.5f, 7}, {0.3f, 2, -0.1f}};
  const CameraBasis basis = camera_basis(camera, 100, 100);
  const double half = half_tangent(60);
  EXPECT_NEAR(length(basis.forward), 1, 1e-15);  // some roundings of 2^-53
  EXPECT_NEAR(length(basis.right), half, 1e-15);
  EXPECT_NEAR(length(basis.up), half, 1e-15);
  EXPECT_NEAR(dot(basis.forward, basis.right), 0, 1e-15);
  EXPECT_NEAR(dot(basis.forward, basis.up), 0, 1e-15);
  EXPECT_NEAR(dot(basis.right, basis.up), 0, 1e-15);
  EXPECT_GT(dot(basis.up, vec_cast<double>(camera.pose.up)), 0);
  const Vec3d to_target = vec_cast<double>(camera.pose.look_at) - basis.eye;
  EXPECT_NEAR(dot(basis.forward, to_target), length(to_target), 1e-14);
}

TEST(CameraBasis, HasNoUseForTheLengthsOfItsVectors) {
  PinholeCamera near = pinhole(45, FovAxis::x), far = near;
  far.pose.look_at = {0, 0, -4096};
  far.pose.up = {0, 64, 0};
  const CameraBasis a = camera_basis(near, 8, 8), b = camera_basis(far, 8, 8);
  EXPECT_EQ(a.forward, b.forward);
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.up, b.up);
}

struct FovCase {
  FovAxis axis;
  int width, height;
  double half_width, half_height;  ///< in units of tan(fov / 2)
};

TEST(CameraBasis, FovSpansTheAxisItNames) {
  const double t = half_tangent(45);
  const FovCase cases[] = {
      {FovAxis::x, 400, 200, 1, 0.5},   {FovAxis::x, 200, 400, 1, 2},
      {FovAxis::y, 400, 200, 2, 1},     {FovAxis::y, 200, 400, 0.5, 1},
      {FovAxis::max, 400, 200, 1, 0.5}, {FovAxis::max, 200, 400, 0.5, 1},
      {FovAxis::max, 300, 300, 1, 1},
  };
  for (const FovCase& c : cases) {
    const CameraBasis basis = camera_basis(pinhole(45, c.axis), c.width, c.height);
    EXPECT_EQ(basis.right.x, t * c.half_width) << c.width << "x" << c.height;
    EXPECT_EQ(basis.up.y, t * c.half_height) << c.width << "x" << c.height;
  }
}

TEST(CameraBasis, PixelsAreSquare) {
  for (const FovAxis axis : {FovAxis::x, FovAxis::y, FovAxis::max}) {
    const CameraBasis basis = camera_basis(pinhole(70, axis), 1920, 1080);
    EXPECT_NEAR(length(basis.right) / 1920, length(basis.up) / 1080, 1e-18);
  }
}

TEST(CameraBasis, OrthographicFilmHasTheStatedHeight) {
  const OrthographicCamera camera{{{1, 2, 3}, {1, 2, 0}, {0, 1, 0}}, 6};
  const CameraBasis basis = camera_basis(camera, 400, 200);
  EXPECT_EQ(basis.kind, CameraKind::parallel);
  EXPECT_EQ(basis.eye, (Vec3d{1, 2, 3}));
  EXPECT_EQ(basis.forward, (Vec3d{0, 0, -1}));
  EXPECT_EQ(basis.right, (Vec3d{6, 0, 0}));
  EXPECT_EQ(basis.up, (Vec3d{0, 3, 0}));
}

}  // namespace
}  // namespace boule
