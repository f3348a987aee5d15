// The statistics of path tracing: its ways of finding light agree, and its error falls as it
// should. The full size is run by hand: ctest -L long -V.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "render/integrators/path.h"
#include "render/prepare/prepared_scene.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/path_scenes.h"
#include "tests/support/test_size.h"

namespace boule::test {
namespace {

/// The radiance of every pixel's centre, as the mean of `count` samples.
std::vector<Color> path_means(const Scene& scene, LightSampling search, std::uint64_t seed,
                              int count) {
  const int width = scene.image.width, height = scene.image.height;
  const PreparedScene prepared = prepare(scene, width, height, serial_for, Method::path).value();
  IntegratorSettings settings;
  settings.max_depth = scene.render.max_depth;
  settings.light_sampling = search;
  settings.seed = seed;
  Path path(prepared, *select_kernels("auto").value(), settings);
  const CameraView view = build_camera(*scene.camera, width, height);
  const auto pixels = static_cast<std::size_t>(width * height);
  RayBuffer rays(pixels);
  std::vector<SampleId> ids(pixels);
  std::vector<Color> radiance(pixels);
  std::vector<Vec3d> sums(pixels);
  for (int sample = 0; sample < count; ++sample) {
    for (std::size_t k = 0; k < pixels; ++k) {
      const int x = static_cast<int>(k) % width, y = static_cast<int>(k) / width;
      ids[k] = {x, y, sample};
      rays.set(k, primary_ray(view, x + 0.5, y + 0.5));
    }
    EXPECT_TRUE(path.trace({rays, prepared.coherence, ids.data()}, radiance.data()));
    for (std::size_t k = 0; k < pixels; ++k) {
      const auto [r, g, b] = radiance[k];
      sums[k] = sums[k] + vec_cast<double>(Vec3f{r, g, b});
    }
  }
  for (std::size_t k = 0; k < pixels; ++k) {
    const Vec3f mean = vec_cast<float>(sums[k] * (1.0 / count));
    radiance[k] = {mean.x, mean.y, mean.z};
  }
  return radiance;
}

/// The quantile of Student's t distribution for the quantile z of the normal one: the first terms
/// of its expansion (Abramowitz and Stegun 26.7.5).
double student(double z, double freedom) {
  return z + (z * z * z + z) / (4 * freedom) +
         (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * freedom * freedom);
}

/// Mean and variance, pixel by pixel, of independent pictures with so many samples.
std::vector<Moments> picture_moments(const Scene& scene, LightSampling search, int pictures,
                                     int samples) {
  std::vector<Moments> moments(static_cast<std::size_t>(scene.image.width * scene.image.height));
  for (int i = 0; i < pictures; ++i) {
    const auto seed = static_cast<std::uint64_t>(1000 * static_cast<int>(search) + i);
    const std::vector<Color> means = path_means(scene, search, seed, samples);
    for (std::size_t k = 0; k < means.size(); ++k) moments[k].add(luminance(means[k]));
  }
  return moments;
}

/// Welch's test in every pixel, at a level of 1 % for all of them together (Sidak's correction;
/// with 576 pixels 4.16 standard deviations). 99.75 % of the pixels must pass. LightSampling::paths
/// finds small lights rarely, so it may have more samples.
void expect_ways_agree(const Scene& scene, int samples, int samples_of_paths) {
  const int pictures = static_cast<int>(test_size("BOULE_PATH_PICTURES", 24));
  const auto both = picture_moments(scene, LightSampling::both, pictures, samples);
  for (const LightSampling search : {LightSampling::lights, LightSampling::paths}) {
    const auto other = picture_moments(scene, search, pictures,
                                       search == LightSampling::paths ? samples_of_paths : samples);
    int failures = 0;
    double sum_of_both = 0, sum_of_other = 0;
    for (std::size_t k = 0; k < both.size(); ++k) {
      const double a = both[k].variance_of_mean(), b = other[k].variance_of_mean();
      const double freedom = (a + b) * (a + b) / (a * a + b * b) * (pictures - 1);
      const double difference = std::fabs(both[k].mean - other[k].mean);
      failures += difference > student(4.16, freedom) * std::sqrt(a + b) + 1e-6 ? 1 : 0;
      sum_of_both += both[k].mean;
      sum_of_other += other[k].mean;
    }
    EXPECT_LE(failures, 0.0025 * static_cast<double>(both.size())) << static_cast<int>(search);
    EXPECT_NEAR(sum_of_other / sum_of_both, 1, 0.01) << static_cast<int>(search);
  }
}

/// A scene whose lights are large enough to be found by directions of paths. At the last bounce
/// light is found by light sampling only, so no bounce may be the last.
Scene scene_of_large_lights() {
  Scene scene = path_scene(24, 24);
  scene.lights = {SphereLight{{2, 4, 3}, 1.6f, {2, 2, 2}}};
  scene.spheres[4].radius = 0.8f;
  scene.spheres[4].center.y = 0.8f;
  scene.render.max_depth = max_count;
  return scene;
}

TEST(PathStatistics, LightStrategiesAgree) { expect_ways_agree(scene_of_large_lights(), 16, 16); }

/// An environment with another colour in every pixel, a sphere light, a lamp and every material.
TEST(PathStatistics, LightStrategiesAgreeInAnEnvironment) {
  Scene scene = scene_of_large_lights();
  EnvironmentBackground image{16, 8, {}, 40};
  for (std::uint64_t i = 0; i < 128; ++i) {
    const auto tone = [i](int shift) {
      return static_cast<float>((mix64(i + golden_step) >> shift) % 256) / 200;
    };
    image.pixels.push_back({tone(0), tone(8), tone(16)});
  }
  scene.background = image;
  scene.planes.pop_back();  // the wall at the back
  expect_ways_agree(scene, 16, 16);
}

/// An image in which one bright pixel gives most of the light. No material mirrors it: caustics of
/// such a small light are found by directions of paths only, too rarely for statistics.
TEST(PathStatistics, LightStrategiesAgreeUnderASmallSun) {
  Scene scene = scene_of_large_lights();
  const auto paint = add_material(scene, Plastic{{0.2f, 0.3f, 0.6f}, 0.3f, 20, 0});
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    if (i != 4) scene.spheres[i].material = i % 2 == 0 ? paint : scene.planes[0].material;
  }
  scene.planes.pop_back();
  EnvironmentBackground image{32, 16, std::vector<Color>(512, {0.1f, 0.15f, 0.3f}), 0};
  image.pixels[4 * 32 + 22] = {120, 100, 80};  // upper right, behind the camera
  scene.background = image;
  expect_ways_agree(scene, 16, 512);
}

/// RMS error over the pixels against the mean of many samples of another seed.
TEST(PathStatistics, ErrorFallsWithTheSampleCount) {
  Scene scene = path_scene(16, 12);
  const int most = static_cast<int>(test_size("BOULE_PATH_SAMPLES", 4096));
  const std::vector<Color> reference = path_means(scene, LightSampling::both, 77, most);
  std::vector<double> logs_n, logs_error;
  for (int n = 4; n <= most / 16; n *= 4) {
    const std::vector<Color> means = path_means(scene, LightSampling::both, 1, n);
    double sum = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
      sum += std::pow(luminance(means[k]) - luminance(reference[k]), 2);
    }
    logs_n.push_back(std::log(n));
    logs_error.push_back(0.5 * std::log(sum / static_cast<double>(means.size())));
    std::printf("%d samples: rms error %.5f\n", n, std::exp(logs_error.back()));
  }
  const auto count = static_cast<double>(logs_n.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < logs_n.size(); ++i) {
    x += logs_n[i] / count;
    y += logs_error[i] / count;
  }
  for (std::size_t i = 0; i < logs_n.size(); ++i) {
    xx += (logs_n[i] - x) * (logs_n[i] - x);
    xy += (logs_n[i] - x) * (logs_error[i] - y);
  }
  EXPECT_LE(xy / xx, -0.48);
}

}  // namespace
}  // namespace boule::test
