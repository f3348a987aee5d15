// Stated noise against references of many samples, on scenes of all kinds. Daily on a few and
// coarsely; in full by hand: ctest -L long -V.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/math/srgb.h"
#include "render/files/scene_file/scene_file.h"
#include "render/image/write_image.h"
#include "render/renderer/renderer.h"
#include "tests/render/path_scenes.h"
#include "tests/render/renderer/noise_scenes.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_size.h"

namespace boule::test {
namespace {

constexpr int width = 24, height = 16;
constexpr float target = 0.02F;

/// A sky whose sun is one pixel of 64 x 32.
void write_sun(const std::string& file) {
  Image sky(64, 32);
  for (Color& pixel : sky.pixels) pixel = {0.3F, 0.4F, 0.6F};
  sky.at(20, 9) = {20000, 18000, 15000};
  ASSERT_TRUE(write_image(sky, file, {}));
}

Scene load(const NoiseScene& scene, const TempDir& folder) {
  auto loaded = scene.text.empty()
                    ? load_scene(std::string(BOULE_SCENES) + "/" + scene.name + ".toml")
                    : load_scene_text(scene.text, (folder.path() / "scene.toml").string());
  EXPECT_TRUE(loaded) << scene.name;
  return std::move(loaded).value().scene;
}

RenderOptions options_for(const NoiseScene& noise_scene, const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.width = width;
  options.height = height;
  options.outline = 0;
  if (noise_scene.path) options.method = Method::path;
  options.noise = target;
  options.spp = usual_max_spp;
  return options;
}

MeasuredPicture render(const Scene& scene, const RenderOptions& options) {
  MeasuredPicture picture({0, 0, width, height});
  EXPECT_TRUE(Renderer::create(scene, options).value().render_measured(picture));
  return picture;
}

double displayed(float v) { return srgb_displayed(static_cast<double>(v)); }

double difference(const Color& a, const Color& b) {
  return std::max({std::abs(displayed(a.r) - displayed(b.r)),
                   std::abs(displayed(a.g) - displayed(b.g)),
                   std::abs(displayed(a.b) - displayed(b.b))});
}

double brightness(const MeasuredPicture& picture) {
  double sum = 0;
  for (const MeasuredPixel& pixel : picture.pixels()) sum += luminance(pixel.color);
  return sum;
}

/// The share of the pixels whose difference from the reference is within what both say of
/// themselves.
double covered(const MeasuredPicture& picture, const MeasuredPicture& reference) {
  double count = 0;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const MeasuredPixel &one = picture.pixels()[i], &truth = reference.pixels()[i];
    const double error =
        std::hypot(static_cast<double>(one.noise), static_cast<double>(truth.noise));
    // A constant colour has no noise, but sums of other lengths round otherwise.
    constexpr double rounding = 1e-6;
    if (difference(one.color, truth.color) <= interval_in_errors * error + rounding) ++count;
  }
  return count / static_cast<double>(picture.pixels().size());
}

TEST(NoiseOfScenes, StatedIntervalsHoldAndMeansAreUnbiased) {
  const auto reference_spp = static_cast<int>(test_size("BOULE_NOISE_REFERENCE", 1024));
  const auto pictures = static_cast<int>(test_size("BOULE_NOISE_PICTURES", 4));
  const std::size_t first = test_size("BOULE_NOISE_FIRST", 0);
  const std::size_t step = test_size("BOULE_NOISE_STEP", 9);  // from scene to scene
  const TempDir folder;
  write_sun((folder.path() / "sun.exr").string());
  const std::vector<NoiseScene> scenes = noise_scenes();
  for (std::size_t i = first; i < scenes.size(); i += step) {
    const Scene scene = load(scenes[i], folder);
    RenderOptions options = options_for(scenes[i], scene);
    RenderOptions fixed = options;
    fixed.noise = 1e-7F;
    fixed.min_spp = fixed.spp = reference_spp;
    fixed.seed = 12345;
    const MeasuredPicture reference = render(scene, fixed);
    Moments share, bias, samples;
    for (int picture = 0; picture < pictures; ++picture) {
      options.seed = static_cast<std::uint64_t>(picture) + 1;
      const MeasuredPicture measured = render(scene, options);
      share.add(covered(measured, reference));
      bias.add(brightness(measured) / brightness(reference) - 1);
      samples.add(noise_reached(measured, options.spp).mean_samples);
    }
    const double error = std::sqrt(bias.variance() / pictures);
    std::printf("%-22s %8.1f spp, within their intervals %.4f, brightness %+.3f %% +- %.3f %%\n",
                (scenes[i].name + (scenes[i].path ? " (path)" : "")).c_str(), samples.mean,
                share.mean, bias.mean * 100, error * 100);
    if (!scenes[i].chance) {
      EXPECT_GE(share.mean, 0.94) << scenes[i].name;
    }
    EXPECT_LE(std::abs(bias.mean), 0.001 + 3 * error) << scenes[i].name;
  }
}

}  // namespace
}  // namespace boule::test
