// Pictures whose noise was asked for: the same bits however they are rendered, unbiased means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "core/math/random.h"
#include "render/renderer/noise_block.h"
#include "render/renderer/renderer.h"
#include "tests/render/path_scenes.h"
#include "tests/render/renderer/measured_pictures.h"

namespace boule::test::noise {
namespace {

constexpr int width = 40, height = 28;

RenderOptions noisy_options(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.noise = 0.06F;
  options.min_spp = 16;
  options.spp = 200;
  options.threads = 2;
  return options;
}

TEST(Noise, IgnoresThreadsTilesAndOrders) {
  const Scene scene = path_scene(width, height);
  const RenderOptions options = noisy_options(scene);
  const std::uint64_t expected = hash_of(measured(scene, options));
  for (const int tile : {1, 5, 16, 64, 1024}) {
    RenderOptions other = options;
    other.tile = tile;
    other.threads = tile == 5 ? 1 : 7;
    other.order = tile == 16 ? PixelOrder::frameless : PixelOrder::rows;
    EXPECT_EQ(hash_of(measured(scene, other)), expected) << tile;
  }
}

TEST(Noise, CropsEqualThePicturesPart) {
  const Scene scene = path_scene(width, height);
  RenderOptions options = noisy_options(scene);
  const MeasuredPicture whole = measured(scene, options);
  for (const PixelRect& crop : {PixelRect{7, 3, 31, 20}, PixelRect{39, 27, 40, 28}}) {
    options.crop = crop;
    EXPECT_EQ(hash_of(measured(scene, options)), hash_of(whole, crop));
  }
}

TEST(Noise, AllWaysToRenderAgree) {
  const Scene scene = path_scene(width, height);
  RenderOptions options = noisy_options(scene);
  options.tile = 8;
  const Image expected = measured(scene, options).image(Alpha::none);
  Renderer renderer = Renderer::create(scene, options).value();
  const auto whole = renderer.render();
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole.value().pixels, expected.pixels);
  std::vector<Color> rows;
  EXPECT_TRUE(renderer.render_bands([&rows](const Image& band) -> Status {
    rows.insert(rows.end(), band.pixels.begin(), band.pixels.end());
    return {};
  }));
  EXPECT_EQ(rows, expected.pixels);
}

TEST(Noise, NoisyPixelsGetMoreSamples) {
  const Scene scene = path_scene(width, height);
  RenderOptions options = noisy_options(scene);
  const MeasuredPicture picture = measured(scene, options);
  std::uint32_t fewest = 1000, most = 0;
  for (const MeasuredPixel& pixel : picture.pixels()) {
    fewest = std::min(fewest, pixel.samples);
    most = std::max(most, pixel.samples);
    if (pixel.samples == 16) {
      EXPECT_LT(pixel.noise, 0.06F);
    }
  }
  EXPECT_EQ(fewest, 16U);
  EXPECT_EQ(most, 200U);
  options.noise = 1;
  const MeasuredPicture coarse = measured(scene, options);
  for (const MeasuredPixel& pixel : coarse.pixels()) EXPECT_EQ(pixel.samples, 16U);
}

TEST(Noise, HalvesStopAtPowersOfTwo) {
  const Scene scene = path_scene(width, height);
  const MeasuredPicture picture = measured(scene, noisy_options(scene));  // 16 to 200 samples
  std::set<std::uint32_t> possible, found;
  for (const std::uint32_t a : {8U, 16U, 32U, 64U, 100U}) {
    for (const std::uint32_t b : {8U, 16U, 32U, 64U, 100U}) possible.insert(a + b);
  }
  for (const MeasuredPixel& pixel : picture.pixels()) found.insert(pixel.samples);
  EXPECT_TRUE(std::includes(possible.begin(), possible.end(), found.begin(), found.end()));
  EXPECT_GE(found.size(), 6U);  // halves of one pixel differ as well
}

TEST(Noise, BrighterExposureNeedsMoreDarkSamples) {
  Scene scene = path_scene(width, height);
  RenderOptions options = noisy_options(scene);
  options.spp = 1000;
  options.exposure_stops = -6;
  const double dark = noise_reached(measured(scene, options), options.spp).mean_samples;
  options.exposure_stops = -1;
  const double bright = noise_reached(measured(scene, options), options.spp).mean_samples;
  EXPECT_LT(dark, bright);
}

TEST(Noise, RefusesOptionsOutOfRangeByName) {
  const Scene scene = path_scene(width, height);
  const auto key_of = [&](const auto& change) {
    RenderOptions options = noisy_options(scene);
    change(options);
    const auto renderer = Renderer::create(scene, options);
    return renderer ? std::string() : renderer.error().key;
  };
  EXPECT_EQ(key_of([](RenderOptions&) {}), "");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.noise = -1; }), "render.noise");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.min_spp = 15; }), "render.min_spp");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.spp = 15; }), "image.spp");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.exposure_stops = 127; }), "exposure_stops");
  const auto without_noise = [](RenderOptions& o) {
    o.noise = 0;
    o.aovs.samples = true;
  };
  EXPECT_EQ(key_of(without_noise), "aov");
}

/// Renders a frame of one block whose samples are gray(value(id)).
MeasuredPicture measured(NoiseBlock& noise, const PixelRect& frame,
                         const std::function<float(const SampleId&)>& value) {
  MeasuredPicture picture(frame);
  noise.begin(frame, frame);
  do {
    for (const auto& [x, y] : noise.wanted()) {
      for (int sample = noise.first(); sample < noise.end(); ++sample) {
        const SampleId id{x, y, sample};
        noise.add(id, gray(value(id)), 1);
      }
    }
  } while (noise.look(picture));
  return picture;
}

/// Renders blocks whose samples are 1 with a probability, else 0: the mean of all pixels.
double mean_of_rare_samples(double probability, int blocks, double* samples) {
  NoiseBlock noise({.half_width = 0.1F, .min_spp = 16, .max_spp = 512});
  double sum = 0;
  *samples = 0;
  for (int block = 0; block < blocks; ++block) {
    const PixelRect frame{0, 0, 32, 32};
    const MeasuredPicture picture = measured(noise, frame, [&](const SampleId& id) {
      const auto bits = philox({static_cast<std::uint32_t>(id.x), static_cast<std::uint32_t>(id.y),
                                static_cast<std::uint32_t>(id.sample), 0},
                               {static_cast<std::uint32_t>(block), 5});
      return unit_interval(bits[0]) < probability ? 1.0F : 0.0F;
    });
    for (const MeasuredPixel& pixel : picture.pixels()) {
      sum += static_cast<double>(pixel.color.g) / frame.area() / blocks;
      *samples += pixel.samples / static_cast<double>(frame.area()) / blocks;
    }
  }
  return sum;
}

/// The first half has noise in its first 8 samples, and none later; the second one none at all, and
/// so decides at once that 8 samples are enough for the first, which goes on to decide for it.
TEST(Noise, CountsOnlyTheSamplesShown) {
  NoiseBlock noise({.half_width = 0.1F, .min_spp = 16, .max_spp = 512});
  const MeasuredPicture picture = measured(noise, {0, 0, 1, 1}, [](const SampleId& id) {
    const bool is_noisy = id.x == 0 && id.sample < 8;
    return !is_noisy ? 0.5F : id.sample % 2 == 0 ? 0.0F : 1.0F;
  });
  const MeasuredPixel& pixel = picture.at(0, 0);
  EXPECT_GT(pixel.samples, 16U);
  EXPECT_EQ(pixel.color, gray(0.5F));
  // Both halves: the mean of 8 / 7 / 4 and 0 divided by either number, and by four.
  const double variance = 1.0 / 7 * (1.0 / 8 + 1.0 / (pixel.samples - 8)) / 4;
  // The curve's slope is 0.66 at 0.5, and greater below; Student's factor is above the normal one.
  EXPECT_GT(pixel.noise, 0.66 * std::sqrt(variance));
}

TEST(Noise, MeanOfRareBrightSamplesIsUnbiased) {
  constexpr int blocks = 16;
  for (const double probability : {0.02, 0.3}) {
    double samples = 0;
    const double mean = mean_of_rare_samples(probability, blocks, &samples);
    EXPECT_GT(samples, 20);
    // A pixel of n samples in either half has the variance p (1 - p) / 2n, which is greatest where
    // n is 8. Five standard errors: pixels that stop by their own samples are off by 6.5 and 12.
    const double variance = probability * (1 - probability) / 16 / (1024.0 * blocks);
    EXPECT_NEAR(mean, probability, 5 * std::sqrt(variance)) << probability;
  }
}

}  // namespace
}  // namespace boule::test::noise
