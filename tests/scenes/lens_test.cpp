// Lenses of real elements: the shipped prescriptions, and every kernel table against a twin that
// traces them in long double by other formulas.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "core/optics/lens_optics.h"
#include "tests/scenes/shipped_lens.h"
#include "tests/support/camera_samples.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/lens_twin.h"

namespace boule::test {
namespace {

/// By a ray at a tenth of a micrometre from the axis.
double traced_focal_length(const LensCamera& camera) {
  TwinRay ray{{1e-4L, 0, -1}, {0, 0, 1}};
  to_film(ray, camera);
  EXPECT_TRUE(ray.there);
  return static_cast<double>(-1e-4L * ray.dir.z / ray.dir.x);
}

TEST(Lens, FocalLengthsAreThePublishedOnes) {
  struct Published {
    LensCamera camera;
    double focal_length;
  };
  for (const auto& [camera, published] :
       {Published{double_gauss(), 50.2}, Published{wide_angle(), 22}}) {
    EXPECT_NEAR(focal_length(camera.surfaces) / published, 1, 0.005);
    EXPECT_NEAR(traced_focal_length(camera), focal_length(camera.surfaces), 1e-6);
  }
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(image_distance(double_gauss().surfaces, inf) / 27.535, 1, 0.005);
}

/// The whole of a beam of that width, from far away along the axis, passes; what is a little wider
/// is stopped.
TEST(Lens, FNumberIsFocalLengthOverBeam) {
  for (const auto& [name, keys] : {std::pair{"double_gauss_50mm.lens", "film_width = 20\n"},
                                   {"wide_angle_22mm.lens", "film_width = 30\n"}}) {
    const LensCamera open = shipped_lens(name, keys);
    for (const int f_number : {4, 8, 16, 64}) {
      LensCamera camera = shipped_lens(name, keys + ("f_number = " + std::to_string(f_number)));
      const auto passes = [&](long double share) {
        const long double height = focal_length(camera.surfaces) / f_number / 2 * share;
        TwinRay ray{{height, 0, -1}, {0, 0, 1}};
        to_film(ray, camera);
        return ray.there;
      };
      EXPECT_TRUE(passes(0.96L)) << name << " f/" << f_number;
      EXPECT_FALSE(passes(1.04L)) << name << " f/" << f_number;
      ASSERT_EQ(camera.surfaces.size(), open.surfaces.size());
      int changed = 0;
      for (std::size_t i = 0; i < open.surfaces.size(); ++i) {
        EXPECT_LE(camera.surfaces[i].aperture, open.surfaces[i].aperture);
        changed += camera.surfaces[i].aperture != open.surfaces[i].aperture ? 1 : 0;
        camera.surfaces[i].aperture = open.surfaces[i].aperture;
        EXPECT_EQ(camera.surfaces[i].radius, open.surfaces[i].radius);
      }
      EXPECT_EQ(changed, 1);
    }
  }
}

class LensKernels : public OnEachIsa {};

/// The pupil box at a distance from the film's middle.
PupilBox box_at(const LensOptics& optics, double distance) {
  const double last = static_cast<double>(optics.pupil.size()) - 1;
  const double place = distance * optics.rings_per_length, ring = std::min(std::floor(place), last);
  const auto& [inner, outer] = optics.pupil[static_cast<std::size_t>(ring)];
  const double share = std::min(place - ring, 1.0);
  return {std::lerp(inner.x0, outer.x0, share), std::lerp(inner.x1, outer.x1, share),
          std::lerp(inner.y, outer.y, share)};
}

/// What the twin makes of one sample: the film point, and the pupil box by its ring.
TwinRay twin_of(const LensCamera& camera, const LensOptics& optics, double film_x, double film_y,
                double a, double b, double& weight) {
  const long double x = -static_cast<long double>(film_x) * optics.half_width;
  const long double y = -static_cast<long double>(film_y) * optics.half_height;
  const long double phi = std::atan2(y, x), distance = std::hypot(x, y);
  const PupilBox box = box_at(optics, static_cast<double>(distance));
  const long double p = box.x0 + (box.x1 - box.x0) * a, q = box.y * (2 * b - 1);
  const Vec3l target{p * std::cos(phi) - q * std::sin(phi), p * std::sin(phi) + q * std::cos(phi),
                     optics.rear};
  TwinRay ray{{x, y, optics.film}, target - Vec3l{x, y, optics.film}};
  const long double length = std::sqrt(dot_of(ray.dir, ray.dir));
  ray.dir = ray.dir * (1 / length);
  weight = static_cast<double>(std::pow(std::fabs(ray.dir.z), 4.0L)) * (box.x1 - box.x0) * 2 *
           box.y * optics.exposure;
  to_scene(ray, camera);
  return ray;
}

TEST_P(LensKernels, EqualTheTwin) {
  constexpr std::size_t many = 1000000;
  constexpr int width = 640, height = 361;
  for (const LensCamera& camera : {double_gauss(), stopped_down(), wide_angle()}) {
    const LensOptics optics = make_optics(camera, width, height);
    const LensOptics lens = build_lens(camera, width, height);
    const CameraView view = build_camera(camera, width, height, nullptr, &lens);
    SampleBuffer samples = random_samples(view, many, width, height, 31);
    const SampleStream at = samples.view();
    RayBuffer rays(many);
    kernels->primary_rays(view, at, rays.view());
    std::size_t differing = 0, passed = 0;
    for (std::size_t i = 0; i < many; ++i) {
      double weight = 0;
      const TwinRay twin =
          twin_of(camera, optics, 2 * at.raster_x[i] / width - 1, 1 - 2 * at.raster_y[i] / height,
                  at.lens_x[i], at.lens_y[i], weight);
      const bool through = samples.weight(i) > 0;
      differing += through != (twin.there && weight > 0) ? 1 : 0;
      if (!through || !twin.there) continue;
      ++passed;
      // The camera stands at the origin and looks along -z: its space is the lens', x, y and z.
      const Ray ray = rays.get(i);
      const Vec3d dir = vec_cast<double>(ray.dir), wanted = vec_cast<double>(twin.dir);
      ASSERT_LE(std::fabs(dir.x - wanted.x), 4 * unit_roundoff) << i;
      ASSERT_LE(std::fabs(dir.y - wanted.y), 4 * unit_roundoff) << i;
      ASSERT_LE(std::fabs(dir.z - wanted.z), 4 * unit_roundoff) << i;
      const Vec3d org = vec_cast<double>(twin.org) * optics.scale;
      ASSERT_LE(length(ray.org - org), unit_roundoff * optics.scale) << i;
      ASSERT_NEAR(static_cast<double>(samples.weight(i)) / weight, 1, 1e-6) << i;
    }
    EXPECT_LE(differing, 1U);
    EXPECT_GT(passed, many / 4);
  }
}

TEST_P(LensKernels, EqualTheScalarPath) {
  for (const LensCamera& camera : {double_gauss(), wide_angle()}) {
    const LensOptics lens = build_lens(camera, 64, 48);
    const CameraView view = build_camera(camera, 64, 48, nullptr, &lens);
    SampleBuffer samples = random_samples(view, 5003, 64, 48, 32);
    RayBuffer wide(samples.size());
    kernels->primary_rays(view, samples.view(), wide.view());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto [ray, weight] = camera_ray(view, sample_of(samples, view, i));
      ASSERT_EQ(samples.weight(i), weight) << i;
      if (weight == 0) continue;
      ASSERT_EQ(wide.get(i).org, ray.org) << i;
      ASSERT_EQ(wide.get(i).dir, ray.dir) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, LensKernels, each_isa(), isa_name);

TEST(Lens, RaysTracedBackwardsReturn) {
  for (const LensCamera& camera : {double_gauss(), wide_angle()}) {
    const LensOptics optics = make_optics(camera, 64, 48);
    CaseRandom random(33);
    int passed = 0;
    for (int i = 0; i < 20000; ++i) {
      const double x = random.uniform(-optics.half_width, optics.half_width);
      const double y = random.uniform(-optics.half_height, optics.half_height);
      const double half = static_cast<double>(camera.surfaces.back().aperture) / 2;
      const double p = random.uniform(-half, half);
      const double q = random.uniform(-half, half);
      Vec3d org{x, y, optics.film};
      Vec3d dir = normalize(Vec3d{p, q, optics.rear} - org);
      if (!trace_lens(optics.elements, org, dir)) continue;
      ++passed;
      TwinRay back{vec_cast<long double>(org + dir), vec_cast<long double>(-dir)};
      to_film(back, camera);
      const long double t = (optics.film - back.org.z) / back.dir.z;
      ASSERT_NEAR(static_cast<double>(back.org.x + t * back.dir.x), x, 1e-9);
      ASSERT_NEAR(static_cast<double>(back.org.y + t * back.dir.y), y, 1e-9);
    }
    EXPECT_GT(passed, 1000);
  }
}

TEST(Lens, FocusIsSharpNearTheAxis) {
  for (const LensCamera& camera : {double_gauss(), wide_angle()}) {
    const LensOptics optics = make_optics(camera, 64, 48);
    for (const double p : {-0.01, 0.005, 0.01}) {
      Vec3d org{0, 0, optics.film};
      Vec3d dir = normalize(Vec3d{p, 0, optics.rear} - org);
      ASSERT_TRUE(trace_lens(optics.elements, org, dir));
      const double meets = org.z - org.x * dir.z / dir.x;
      EXPECT_NEAR(meets, -3000, 1);  // mm
    }
  }
}

TEST(Lens, TheExitPupilIsInsideItsBoxes) {
  for (const LensCamera& camera : {double_gauss(), stopped_down(), wide_angle()}) {
    const LensOptics optics = make_optics(camera, 64, 48);
    CaseRandom random(34);
    int passed = 0, outside = 0;
    for (int i = 0; i < 2000000; ++i) {
      const double r = random.uniform(0, 64 / optics.rings_per_length);
      const double half = static_cast<double>(camera.surfaces.back().aperture) * 0.75;
      const double p = random.uniform(-half, half);
      const double q = random.uniform(-half, half);
      Vec3d org{r, 0, optics.film};
      Vec3d dir = normalize(Vec3d{p, q, optics.rear} - org);
      if (!trace_lens(optics.elements, org, dir)) continue;
      ++passed;
      const PupilBox box = box_at(optics, r);
      outside += p < box.x0 || p > box.x1 || std::fabs(q) > box.y ? 1 : 0;
    }
    EXPECT_GT(passed, 10000);
    EXPECT_EQ(outside, 0);
  }
}

/// What a pinhole lets through goes with its area; and it is found in steps, not by its size: or
/// this would never end.
TEST(Lens, NarrowStopsAreFound) {
  LensCamera camera = double_gauss();
  const auto stop = std::find_if(camera.surfaces.begin(), camera.surfaces.end(),
                                 [](const LensSurface& s) { return s.radius == 0; });
  ASSERT_NE(stop, camera.surfaces.end());
  double last = 0;
  for (const float diameter : {1.0f, 0.1f, 0.01f, 1e-3f, 1e-6f}) {
    stop->aperture = diameter;
    const LensOptics optics = make_optics(camera, 640, 480);
    const double light = 1 / optics.exposure / std::pow(double{diameter}, 2);
    if (last > 0) {
      EXPECT_NEAR(light / last, 1, 0.02) << diameter;
    }
    last = light;
    const auto seen =
        std::count_if(optics.pupil.begin(), optics.pupil.end(),
                      [](const PupilRing& ring) { return ring.inner.x0 < ring.inner.x1; });
    EXPECT_EQ(seen, 64) << diameter;
  }
}

/// The light of a white world at a place of a picture of 64 x 48 pixels.
double light_at(const LensCamera& camera, double x, double y) {
  const LensOptics lens = build_lens(camera, 64, 48);
  const CameraView view = build_camera(camera, 64, 48, nullptr, &lens);
  SampleBuffer samples = random_samples(view, 40000, 64, 48, 35);
  for (std::size_t i = 0; i < samples.size(); ++i) samples.set(i, x, y);
  RayBuffer rays(samples.size());
  reference_kernels().primary_rays(view, samples.view(), rays.view());
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) sum += static_cast<double>(samples.weight(i));
  return sum / static_cast<double>(samples.size());
}

TEST(Lens, WhiteWorldDarkensTowardsTheCorners) {
  for (const LensCamera& camera : {double_gauss(), wide_angle()}) {
    EXPECT_NEAR(light_at(camera, 32, 24), 1, 0.01);
    const double half_way = light_at(camera, 48, 36), corner = light_at(camera, 63.5, 47.5);
    EXPECT_LT(half_way, 0.99);
    EXPECT_LT(corner, 0.8 * half_way);
    EXPECT_GT(corner, 0.01);
  }
}

/// As in photography: stopped down hardly a rim but the stop's is in the way, and what is left is
/// cos^4.
TEST(Lens, StoppedDownItsCornersAreBrighter) {
  const LensCamera camera = stopped_down();
  EXPECT_NEAR(light_at(camera, 32, 24), 1, 0.01);
  const double corner = light_at(camera, 63.5, 47.5);
  EXPECT_GT(corner, 1.5 * light_at(double_gauss(), 63.5, 47.5));
  EXPECT_LT(corner, 0.97);
}

}  // namespace
}  // namespace boule::test
