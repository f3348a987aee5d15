// What is told while noise is measured.
#include <gtest/gtest.h>

#include <vector>

#include "render/frame/progress.h"
#include "render/renderer/renderer.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// Where noise is measured, pixels count, also those of blocks that still go on.
TEST(LiveProgress, CountsMeasuredPixels) {
  LiveProgress live;
  live.begin_pass(2, {.begin = 0.5, .end = 1, .pixels = 40});
  live.begin_block();
  live.begin_block();
  live.add_measured({10, 320, 9});
  EXPECT_EQ(live.read().share, 0.625);
  EXPECT_EQ(live.read().resumed, 0.5);
  live.add_measured({10, 4096, 2});
  live.end_block(1);
  live.add_measured({20, 640, 20});
  EXPECT_LT(live.read().share, 1);  // the last block has not ended
  EXPECT_GT(live.read().share, 0.999);
  live.end_block(1);
  const Progress progress = live.read();
  EXPECT_EQ(progress.share, 1);
  EXPECT_EQ(progress.noise.pixels, 40u);
  EXPECT_EQ(progress.noise.samples, 5056u);
  EXPECT_EQ(progress.noise.settled, 31u);

  live.begin_pass(1, {.begin = 0.5, .end = 1, .pixels = 10});  // goes on: what was measured stays
  live.add_measured({5, 160, 5});
  EXPECT_EQ(live.read().share, 0.75);
  EXPECT_EQ(live.read().noise.pixels, 45u);
  live.restart();
  EXPECT_EQ(live.read().noise.pixels, 0u);
  EXPECT_EQ(live.read().share, 0);
}

/// What is told while noise is measured adds up to what the picture says.
TEST(Renderer, ReportsFallingNoise) {
  const Scene scene = mixed_scene(96, 80);
  RenderOptions options = options_of(scene);
  options.noise = 0.05F;
  options.spp = 128;
  options.threads = 2;
  LiveProgress live;
  options.live = &live;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  MeasuredPicture picture(renderer.value().rect());
  ASSERT_TRUE(renderer.value().render_measured(picture));
  const NoiseReached reached = noise_reached(picture, options.spp);
  const Progress progress = live.read();
  EXPECT_EQ(progress.share, 1);
  ASSERT_EQ(progress.noise.pixels, 96u * 80);
  EXPECT_EQ(static_cast<double>(progress.noise.samples) / 7680, reached.mean_samples);
  EXPECT_EQ(static_cast<double>(progress.noise.settled) / 7680, reached.share);
  EXPECT_GT(reached.share, 0.5);
  EXPECT_LT(reached.share, 1);
}

/// A preview does not bring the progress to its end, and counts no pixel as measured.
TEST(Renderer, ReportsNoiseAfterAPreview) {
  const Scene scene = mixed_scene(96, 80);
  RenderOptions options = options_of(scene);
  options.noise = 0.05F;
  options.spp = 64;
  options.threads = 1;
  LiveProgress live;
  options.live = &live;
  std::vector<Progress> told;
  options.progress = [&](const Progress& progress) { told.push_back(progress); };
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  MeasuredPicture picture(renderer.value().rect()), alone(picture.rect());
  Film film(picture.rect());
  ASSERT_TRUE(renderer.value().render_measured(picture, &film));
  EXPECT_EQ(film.total_samples(), 7680u);
  ASSERT_GT(told.size(), 2u);
  for (std::size_t i = 1; i < told.size(); ++i) {
    EXPECT_GE(told[i].share, told[i - 1].share);
    EXPECT_GE(told[i].rays, told[i - 1].rays);
    EXPECT_EQ(told[i].share > 0.02, told[i].noise.pixels > 0);
  }
  EXPECT_EQ(told.back().share, 1);
  EXPECT_EQ(told.back().rays, renderer.value().statistics().rays.total());
  ASSERT_TRUE(renderer.value().render_measured(alone));
  EXPECT_EQ(picture.samples(), alone.samples());
  EXPECT_EQ(picture.noise(), alone.noise());
}

}  // namespace
}  // namespace boule::test
