// Camera rays of every kernel table against what the formulas of core/scene/camera.h say, written
// down once more: in double, with the standard library's functions, from angles where the kernels
// have polynomials.
#include <cmath>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "tests/support/camera_samples.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::camera_twin {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t many = 1000000;
const CameraPose pose{{2.1F, 1.3F, 1.7F}, {0.1F, -0.2F, 0.3F}, {0, 0, 1}};

/// A frame of square pixels and the camera's axes, from the pose alone.
struct Frame {
  int width, height;
  Vec3d eye = vec_cast<double>(pose.eye);
  Vec3d l = normalize(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
  Vec3d u = normalize(cross(l, vec_cast<double>(pose.up)));
  Vec3d v = cross(u, l);

  /// Film coordinates: as long as the film is along `axis` they are -1 .. 1 there.
  [[nodiscard]] double film_x(double raster_x, FovAxis axis) const {
    return (2 * raster_x - width) / side(axis);
  }
  [[nodiscard]] double film_y(double raster_y, FovAxis axis) const {
    return (height - 2 * raster_y) / side(axis);
  }
  [[nodiscard]] double side(FovAxis axis) const {
    return axis == FovAxis::x ? width : axis == FovAxis::y ? height : std::max(width, height);
  }
};

/// A ray of the twin; none where `there` is false.
struct TwinRay {
  Vec3d org, dir;
  bool there = true;
};

TwinRay fisheye_twin(const FisheyeCamera& camera, const Frame& frame, double raster_x,
                     double raster_y) {
  const double half = static_cast<double>(camera.fov) / 2 * pi / 180;
  const double x = frame.film_x(raster_x, camera.fov_axis);
  const double y = frame.film_y(raster_y, camera.fov_axis);
  const double theta = half * std::hypot(x, y), phi = std::atan2(y, x);
  const Vec3d outward = frame.u * std::cos(phi) + frame.v * std::sin(phi);
  return {frame.eye, frame.l * std::cos(theta) + outward * std::sin(theta), theta <= pi};
}

TwinRay thin_lens_twin(const ThinLensCamera& camera, const Frame& frame, double raster_x,
                       double raster_y, double lens_x, double lens_y) {
  const double tangent = std::tan(static_cast<double>(camera.fov) / 2 * pi / 180);
  const double x = tangent * frame.film_x(raster_x, camera.fov_axis);
  const double y = tangent * frame.film_y(raster_y, camera.fov_axis);
  const double focus = static_cast<double>(*camera.focus);
  const Vec3d sharp = frame.eye + (frame.l + frame.u * x + frame.v * y) * focus;
  // Shirley and Chiu: squares to circles, a quarter of the circle for each side.
  const double a = 2 * lens_x - 1, b = 2 * lens_y - 1;
  const bool sides = std::fabs(a) > std::fabs(b);
  const double radius = static_cast<double>(camera.aperture) * (sides ? a : b);
  const double angle = sides ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
  const Vec3d org = frame.eye + (frame.u * std::cos(angle) + frame.v * std::sin(angle)) * radius;
  return {org, normalize(sharp - org)};
}

class CameraTwin : public OnEachIsa {};

RayBuffer rays_of(const KernelTable& kernels, const CameraView& camera, SampleBuffer& samples) {
  RayBuffer rays(samples.size());
  kernels.primary_rays(camera, samples.view(), rays.view());
  return rays;
}

void expect_close(const Ray& ray, const TwinRay& twin, std::size_t i) {
  const Vec3d dir = vec_cast<double>(ray.dir);
  ASSERT_LE(std::fabs(dir.x - twin.dir.x), unit_roundoff) << i;
  ASSERT_LE(std::fabs(dir.y - twin.dir.y), unit_roundoff) << i;
  ASSERT_LE(std::fabs(dir.z - twin.dir.z), unit_roundoff) << i;
  ASSERT_LE(length(ray.org - twin.org), unit_roundoff) << i;
}

TEST_P(CameraTwin, Pinhole) {
  const Frame frame{640, 361};
  for (const PinholeCamera& camera :
       {PinholeCamera{pose, 45, FovAxis::x}, PinholeCamera{pose, 150, FovAxis::y},
        PinholeCamera{pose, 0.1F, FovAxis::max}}) {
    const CameraView view = build_camera(camera, frame.width, frame.height);
    EXPECT_FALSE(view.weighs);
    SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 17);
    const RayBuffer rays = rays_of(*kernels, view, samples);
    const SampleStream at = samples.view();
    const double tangent = std::tan(static_cast<double>(camera.fov) * pi / 360);
    for (std::size_t i = 0; i < many; ++i) {
      const double x = tangent * frame.film_x(at.raster_x[i], camera.fov_axis);
      const double y = tangent * frame.film_y(at.raster_y[i], camera.fov_axis);
      const double cosine = 1 / std::hypot(1, x, y);
      expect_close(rays.get(i), {frame.eye, (frame.l + frame.u * x + frame.v * y) * cosine}, i);
    }
  }
}

TEST_P(CameraTwin, Orthographic) {
  const Frame frame{640, 361};
  const OrthographicCamera camera{pose, 3.7F};
  const CameraView view = build_camera(camera, frame.width, frame.height);
  SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 18);
  const RayBuffer rays = rays_of(*kernels, view, samples);
  const SampleStream at = samples.view();
  const double half = static_cast<double>(camera.height) / 2;
  for (std::size_t i = 0; i < many; ++i) {
    const double x = half * frame.film_x(at.raster_x[i], FovAxis::y);
    const double y = half * frame.film_y(at.raster_y[i], FovAxis::y);
    expect_close(rays.get(i), {frame.eye + frame.u * x + frame.v * y, frame.l}, i);
  }
}

TEST_P(CameraTwin, Fisheye) {
  const Frame frame{640, 361};
  for (const FisheyeCamera& camera :
       {FisheyeCamera{pose, 360, FovAxis::x}, FisheyeCamera{pose, 160, FovAxis::y},
        FisheyeCamera{pose, 1, FovAxis::max}}) {
    const CameraView view = build_camera(camera, frame.width, frame.height);
    SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 11);
    const RayBuffer rays = rays_of(*kernels, view, samples);
    const SampleStream at = samples.view();
    std::size_t dark = 0;
    for (std::size_t i = 0; i < many; ++i) {
      const TwinRay twin = fisheye_twin(camera, frame, at.raster_x[i], at.raster_y[i]);
      const float weight = view.weighs ? samples.weight(i) : 1;
      ASSERT_EQ(weight, twin.there ? 1 : 0) << i;
      if (twin.there) {
        expect_close(rays.get(i), twin, i);
      } else {
        ++dark;
      }
    }
    EXPECT_EQ(view.weighs, camera.fov == 360);
    EXPECT_EQ(dark > 0, camera.fov == 360);  // the corners of a picture wider than high
  }
}

// Directions, the way back: direction -> film -> direction.
TEST_P(CameraTwin, FisheyeThereAndBack) {
  const Frame frame{500, 400};
  const FisheyeCamera camera{pose, 360, FovAxis::y};
  const CameraView view = build_camera(camera, frame.width, frame.height);
  CaseRandom random(12);
  SampleBuffer samples;
  samples.resize(10000, view);
  std::vector<Vec3d> wanted;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3d d = random.direction();
    const double x = dot(d, frame.u), y = dot(d, frame.v), z = dot(d, frame.l);
    const double theta = std::atan2(std::hypot(x, y), z), phi = std::atan2(y, x);
    const double radius = theta / pi * frame.height / 2;  // pixels from the middle
    samples.set(i, frame.width / 2.0 + radius * std::cos(phi),
                frame.height / 2.0 - radius * std::sin(phi));
    wanted.push_back(d);
  }
  const RayBuffer rays = rays_of(*kernels, view, samples);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    ASSERT_EQ(samples.weight(i), 1);
    ASSERT_LT(length(vec_cast<double>(rays.get(i).dir) - wanted[i]), 1e-5) << i;
  }
}

TEST_P(CameraTwin, ThinLens) {
  const Frame frame{640, 361};
  for (const ThinLensCamera& camera : {ThinLensCamera{pose, 45, FovAxis::x, 0.3F, 2.5F},
                                       ThinLensCamera{pose, 120, FovAxis::y, 2.0F, 0.7F}}) {
    const CameraView view = build_camera(camera, frame.width, frame.height);
    SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 13);
    const RayBuffer rays = rays_of(*kernels, view, samples);
    const SampleStream at = samples.view();
    for (std::size_t i = 0; i < many; ++i) {
      expect_close(
          rays.get(i),
          thin_lens_twin(camera, frame, at.raster_x[i], at.raster_y[i], at.lens_x[i], at.lens_y[i]),
          i);
    }
  }
}

/// Bilinear by areas: each of the four pixels around a point weighs what is opposite to it.
double map_twin(const DistortionMap& map, double x, double y, std::size_t component) {
  const double left = std::fmin(std::fmax(std::floor(x), 0), map.width - 2);
  const double top = std::fmin(std::fmax(std::floor(y), 0), map.height - 2);
  double sum = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double column = left + i, row = top + j;
      const double area = (i == 1 ? x - left : left + 1 - x) * (j == 1 ? y - top : top + 1 - y);
      const auto pixel = static_cast<std::size_t>(row * map.width + column);
      sum += area * static_cast<double>(map.st[2 * pixel + component]);
    }
  }
  return sum;
}

/// Where a map sends a raster point.
struct MappedPoint {
  double x, y;
};
MappedPoint mapped(const DistortionMap& map, const Frame& frame, double raster_x, double raster_y) {
  const double x = raster_x * map.width / frame.width - 0.5;
  const double y = raster_y * map.height / frame.height - 0.5;
  const double s = map_twin(map, x, y, 0), t = map_twin(map, x, y, 1);
  return {s * frame.width, (1 - t) * frame.height};
}

TEST_P(CameraTwin, Distortion) {
  const Frame frame{640, 361};
  const DistortionMap map = random_map(9, 6, 0.08);
  const FisheyeCamera camera{pose, 200, FovAxis::x};
  const CameraView view = build_camera(camera, frame.width, frame.height, &map);
  EXPECT_TRUE(view.weighs);
  SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 15);
  const RayBuffer rays = rays_of(*kernels, view, samples);
  const SampleStream at = samples.view();
  for (std::size_t i = 0; i < many; ++i) {
    const auto [x, y] = mapped(map, frame, at.raster_x[i], at.raster_y[i]);
    const TwinRay twin = fisheye_twin(camera, frame, x, y);
    ASSERT_TRUE(twin.there);
    ASSERT_EQ(samples.weight(i), 1);
    expect_close(rays.get(i), twin, i);
  }
}

TEST_P(CameraTwin, DistortedThinLens) {
  const Frame frame{640, 361};
  const DistortionMap map = random_map(5, 7, 0.08);
  const ThinLensCamera camera{pose, 60, FovAxis::y, 0.3F, 2.5F};
  const CameraView view = build_camera(camera, frame.width, frame.height, &map);
  SampleBuffer samples = random_samples(view, many, frame.width, frame.height, 19);
  const RayBuffer rays = rays_of(*kernels, view, samples);
  const SampleStream at = samples.view();
  for (std::size_t i = 0; i < many; ++i) {
    const auto [x, y] = mapped(map, frame, at.raster_x[i], at.raster_y[i]);
    expect_close(rays.get(i), thin_lens_twin(camera, frame, x, y, at.lens_x[i], at.lens_y[i]), i);
  }
}

TEST_P(CameraTwin, TheIdentityMapChangesNothing) {
  const DistortionMap map{2, 2, {0.25F, 0.75F, 0.75F, 0.75F, 0.25F, 0.25F, 0.75F, 0.25F}};
  const PinholeCamera camera{pose, 60, FovAxis::x};
  const CameraView plain = build_camera(camera, 64, 36),
                   mapped = build_camera(camera, 64, 36, &map);
  SampleBuffer samples = random_samples(plain, 10000, 64, 36, 16);  // beyond the map's rim, too
  const RayBuffer expected = rays_of(*kernels, plain, samples);
  const RayBuffer rays = rays_of(*kernels, mapped, samples);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    expect_close(rays.get(i), {expected.get(i).org, vec_cast<double>(expected.get(i).dir)}, i);
  }
}

/// Rays through one film point, each through another point of the lens.
RayBuffer fan(const KernelTable& kernels, const CameraView& view, double x, double y,
              std::size_t side) {
  SampleBuffer samples;
  samples.resize(side * side, view);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.set(i, x, y);
    samples.set_lens(i, (static_cast<double>(i % side) + 0.5) / static_cast<double>(side),
                     (static_cast<double>(i / side) + 0.5) / static_cast<double>(side));
  }
  return rays_of(kernels, view, samples);
}

TEST_P(CameraTwin, PointsInFocusAreSharp) {
  const Frame frame{64, 36};
  const ThinLensCamera camera{pose, 70, FovAxis::x, 0.5F, 4.0F};
  const CameraView view = build_camera(camera, frame.width, frame.height);
  for (const double x : {0.5, 20.25, 63.0}) {
    const RayBuffer rays = fan(*kernels, view, x, 9.5, 40);
    const double focus = 4;
    Vec3d low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray ray = rays.get(i);
      const Vec3d d = vec_cast<double>(ray.dir);
      const double t = (focus - dot(ray.org - frame.eye, frame.l)) / dot(d, frame.l);
      const Vec3d p = ray.org + d * t;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_LT(length(high - low), 1e-5 * focus);
  }
}

TEST_P(CameraTwin, LensSamplesCoverADiscEvenly) {
  const ThinLensCamera camera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 45, FovAxis::x, 1, 1.0F};
  const RayBuffer rays = fan(*kernels, build_camera(camera, 4, 4), 2, 2, 1000);
  double sum_x = 0, sum_y = 0, sum_squares = 0, inner = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3d p = rays.get(i).org;
    const double squared = p.x * p.x + p.y * p.y;
    ASSERT_LE(squared, 1 + 1e-12);
    sum_x += p.x, sum_y += p.y, sum_squares += squared;
    inner += p.x > 0 && p.y > 0 && squared < 0.25 ? 1 : 0;
  }
  const auto n = static_cast<double>(rays.size());
  EXPECT_NEAR(sum_x / n, 0, 1e-9);
  EXPECT_NEAR(sum_y / n, 0, 1e-9);
  EXPECT_NEAR(sum_squares / n, 0.5, 1e-5);  // of a disc; the midpoint rule's error
  EXPECT_NEAR(inner / n, 1.0 / 16, 1e-3);
}

TEST_P(CameraTwin, LensesOfRadiusZeroArePinholes) {
  const PinholeCamera pinhole{pose, 45, FovAxis::y};
  const CameraView view = build_camera(pinhole, 640, 361);
  SampleBuffer samples = random_samples(view, 1003, 640, 361, 14);
  const RayBuffer expected = rays_of(*kernels, view, samples);
  for (const float aperture : {0.0F, 0.25F}) {
    const ThinLensCamera camera{pose, 45, FovAxis::y, aperture, 3.0F};
    const CameraView lens = build_camera(camera, 640, 361);
    EXPECT_EQ(has_lens(lens.kind), aperture > 0);
    SampleBuffer same = random_samples(view, 1003, 640, 361, 14);
    same.resize(1003, lens);  // in the lens' centre
    const RayBuffer rays = rays_of(*kernels, lens, same);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(rays.get(i).org, expected.get(i).org) << i;
      ASSERT_EQ(rays.get(i).dir, expected.get(i).dir) << i;
    }
  }
}

TEST_P(CameraTwin, DefaultFocusIsLookAt) {
  const ThinLensCamera at_look_at{pose, 45, FovAxis::x, 0.5F, {}};
  const RayBuffer rays = fan(*kernels, build_camera(at_look_at, 4, 4), 2, 2, 8);
  const Vec3d target = vec_cast<double>(pose.look_at);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3d to_target = target - rays.get(i).org;
    const Vec3d d = vec_cast<double>(rays.get(i).dir);
    ASSERT_LT(length(cross(to_target, d)), 1e-6 * length(to_target));
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, CameraTwin, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::camera_twin
