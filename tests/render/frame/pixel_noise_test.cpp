#include "render/frame/pixel_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/coverage.h"
#include "core/math/random.h"
#include "core/math/srgb.h"

namespace boule::test {
namespace {

/// Whole numbers below 64, whose sums are exact.
std::vector<float> random_numbers(int count) {
  std::vector<float> numbers;
  for (int i = 0; i < count; ++i)
    numbers.push_back(static_cast<float>(mix64(static_cast<std::uint64_t>(i) + 7) % 64));
  return numbers;
}

TEST(PixelNoise, AHalfHasEightToSixteenBatches) {
  SampleHalf half;
  for (int i = 1; i <= 5000; ++i) {
    half.add(gray(1), whole_coverage);
    EXPECT_EQ(half.count(), i);
    if (i < 8) {
      EXPECT_EQ(half.batches(), i);
    } else {
      EXPECT_GE(half.batches(), 8) << i;
      EXPECT_LE(half.batches(), 16) << i;
    }
  }
  EXPECT_EQ(half.mean(), (PixelNumbers{1, 1, 1, 1}));
  EXPECT_EQ(half.variance(), (PixelNumbers{}));
}

TEST(PixelNoise, VarianceEqualsTheBatchMeans) {
  constexpr int length = 8, batches = 12;
  const std::vector<float> numbers = random_numbers(length * batches);
  SampleHalf half;
  std::array<double, batches> means{};
  double mean = 0;
  for (int i = 0; i < length * batches; ++i) {
    const float number = numbers[static_cast<std::size_t>(i)];
    half.add({number, 2 * number, 0}, number < 32 ? whole_coverage : std::uint8_t{0});
    means[static_cast<std::size_t>(i / length)] += static_cast<double>(number) / length;
    mean += static_cast<double>(number) / (length * batches);
  }
  ASSERT_EQ(half.batches(), batches);
  double squares = 0;
  for (const double one : means) squares += (one - mean) * (one - mean);
  const double variance = squares / (batches - 1) * length;
  // Other orders of rounding: a few ulp of the squares.
  EXPECT_NEAR(half.variance()[0], variance, 1e-12 * variance);
  EXPECT_NEAR(half.variance()[1], 4 * variance, 4e-12 * variance);
  EXPECT_EQ(half.variance()[2], 0);
  EXPECT_NEAR(half.mean()[0], mean, 1e-13 * mean);
}

TEST(PixelNoise, VarianceOverflowsToInfinity) {
  SampleHalf half;
  for (int i = 0; i < 32; ++i) half.add(gray(std::numeric_limits<float>::max()), 1);
  EXPECT_EQ(half.variance()[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(half.variance()[3], 0);
}

TEST(PixelNoise, StudentsQuantilesFallToTheNormalOne) {
  EXPECT_EQ(student_quantile(1), 12.706);
  EXPECT_EQ(student_quantile(7), 2.365);
  EXPECT_EQ(student_quantile(30), 2.042);
  for (int degrees = 1; degrees < 200; ++degrees)
    EXPECT_GT(student_quantile(degrees), student_quantile(degrees + 1)) << degrees;
  EXPECT_NEAR(student_quantile(60), 2.0003, 1e-3);  // of tables; the series is that good
}

TEST(PixelNoise, DisplayedHalfWidthFollowsTheToneCurve) {
  EXPECT_EQ(displayed_half_width(0.5, 0), 0);
  EXPECT_EQ(displayed_half_width(2, 0.5), 0);  // white whatever it is
  EXPECT_EQ(displayed_half_width(0, 0.002), srgb_from_linear(0.002));
  EXPECT_EQ(displayed_half_width(0.5, 0.1), srgb_from_linear(0.5) - srgb_from_linear(0.4));
  EXPECT_EQ(displayed_half_width(1.5, 1), srgb_from_linear(1) - srgb_from_linear(0.5));
  EXPECT_EQ(displayed_half_width(0.001, 0.5), srgb_from_linear(0.501) - srgb_from_linear(0.001));
}

TEST(PixelNoise, ToneCurveInverseIsExact) {
  for (int code = 0; code <= 1000; ++code) {
    const double s = code / 1000.0;
    // The standard's two pieces of the curve meet to about 1e-8 only.
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(s)), s, 4e-8) << s;
  }
}

TEST(PixelNoise, DisplayedHalfWidthBoundHolds) {
  for (int step = -4000; step <= 100; ++step) {
    const double value = std::exp2(step / 200.0);
    for (const double share : {0.0, 1e-9, 1e-4, 0.01, 0.3, 0.9, 1.0, 1.5, 100.0}) {
      const double half_width = share * value, shown = displayed_half_width(value, half_width),
                   bound = most_displayed_half_width(value, half_width);
      EXPECT_GE(bound, shown * (1 - 1e-6)) << value << ' ' << share;  // the differences' rounding
      if (share <= 0.01 && value <= 1) {
        EXPECT_LE(bound, std::max(1.53 * shown, 1e-12)) << value << ' ' << share;
      }
    }
  }
}

TEST(PixelNoise, DecisionsComeAtPowersOfTwo) {
  int count = 16;
  for (const int next : {32, 64, 128, 256}) {
    count = next_look(count);
    EXPECT_EQ(count, next);
  }
  EXPECT_EQ(next_look(12), 16);
  EXPECT_EQ(next_look(33), 64);
}

}  // namespace
}  // namespace boule::test
