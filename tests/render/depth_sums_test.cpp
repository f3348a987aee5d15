#include "render/integrators/depth_sums.h"

#include <gtest/gtest.h>

#include <limits>

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

TEST(FilmValue, IsFinite) {
  EXPECT_EQ(film_value(1.5f), 1.5f);
  EXPECT_EQ(film_value(0.0f), 0.0f);
  EXPECT_EQ(film_value(largest), largest);
  EXPECT_EQ(film_value(inf), largest);
  EXPECT_EQ(film_value(std::numeric_limits<float>::quiet_NaN()), 0.0f);
}

TEST(DepthSums, AddsDepthByDepthWhateverTheOrderOfCalls) {
  // 1 is lost beside 2^24, two of them are not: the order of the sum shows.
  constexpr float big = 16777216;
  DepthSums sums;
  Color result;
  sums.start(1);
  sums.at_depth(2)[0] = gray(1);
  sums.at_depth(0)[0] = gray(1);
  sums.at_depth(1)[0] = gray(big);
  sums.finish(&result);
  EXPECT_EQ(result, gray((1 + big) + 1));
  sums.start(1);
  sums.at_depth(0)[0] = gray(1);
  sums.at_depth(1)[0] = gray(1);
  sums.finish_below(2);
  sums.at_depth(2)[0] = gray(big);
  sums.finish(&result);
  EXPECT_EQ(result, gray(big + 2));
}

TEST(DepthSums, ForgetsWhatWasBeforeStart) {
  DepthSums sums;
  sums.start(3);
  sums.at_depth(4)[2] = gray(9);
  sums.finish_below(2);
  sums.start(2);
  sums.at_depth(0)[1] = gray(5);
  Color result[2];
  sums.finish(result);
  EXPECT_EQ(result[0], gray(0));
  EXPECT_EQ(result[1], gray(5));
}

TEST(DepthSums, ClampsTheTotal) {
  DepthSums sums;
  Color result;
  sums.start(1);
  for (int depth = 0; depth < 3; ++depth) sums.at_depth(depth)[0] = gray(largest);
  sums.finish(&result);
  EXPECT_EQ(result, gray(largest));
}

}  // namespace
}  // namespace boule
