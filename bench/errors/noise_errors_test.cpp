#include "bench/errors/noise_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/path_scenes.h"

namespace boule::bench {
namespace {

NoiseError at(double seconds, double within_99) {
  NoiseError error;
  error.seconds = seconds;
  error.within_99 = within_99;
  return error;
}

TEST(NoiseErrors, TimeIsReadBetweenPicturesOnLogarithmicAxes) {
  const std::vector<NoiseError> errors{at(1, 0.4), at(2, 0.2), at(8, 0.1)};
  EXPECT_EQ(seconds_until(0.5, errors), 1);
  EXPECT_EQ(seconds_until(0.4, errors), 1);
  EXPECT_NEAR(seconds_until(0.2, errors), 2, 1e-12);
  EXPECT_NEAR(seconds_until(0.1, errors), 8, 1e-12);
  EXPECT_NEAR(seconds_until(std::sqrt(0.02), errors), 4, 1e-12);  // in the middle of the last two
  EXPECT_NEAR(seconds_until(0.05, errors), 32, 1e-12);            // beyond: four times the time
}

TEST(NoiseErrors, MoreSamplesCostMoreAndErrLess) {
  constexpr int width = 24, height = 16;
  const NoiseErrors errors = measure_noise_errors(
      test::path_scene(width, height), {.width = width, .height = height, .reference = 512});
  ASSERT_EQ(errors.uniform.size(), 2U);  // 16 and 32 samples
  ASSERT_EQ(errors.random.size(), 2U);
  ASSERT_EQ(errors.to_order.size(), 4U);
  for (const auto* pictures : {&errors.uniform, &errors.random, &errors.to_order}) {
    EXPECT_GE(pictures->front().mean_samples, 16);
    EXPECT_LT(pictures->front().mean_samples, pictures->back().mean_samples);
    EXPECT_LT(pictures->front().mrays, pictures->back().mrays);
    EXPECT_GT(pictures->front().rms, pictures->back().rms);
    EXPECT_GT(pictures->back().rms, 0);
    EXPECT_LE(pictures->back().within_95, pictures->back().within_99);
  }
}

}  // namespace
}  // namespace boule::bench
