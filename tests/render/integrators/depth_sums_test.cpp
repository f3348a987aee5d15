#include "render/integrators/depth_sums.h"

#include <gtest/gtest.h>

#include <limits>

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

ColorSum sum_of(float grey) { return {{grey, grey, grey, 0}}; }

TEST(Settled, LeavesFiniteSamplesUnchanged) {
  SampleFaults faults;
  for (const Color& good : {Color{}, Color{1.5f, 0, 1e-45f}, gray(largest)}) {
    EXPECT_EQ(settled(good, faults), good);
  }
  EXPECT_FALSE(faults.any());
}

TEST(Settled, ReplacesAndCountsNonFiniteSamples) {
  SampleFaults faults;
  EXPECT_EQ(settled({1, nan, 1}, faults), Color{});
  EXPECT_EQ(settled({inf, 2, nan}, faults), Color{});
  EXPECT_EQ(settled({inf, 2, 0}, faults), (Color{largest, 2, 0}));
  EXPECT_EQ(faults.not_finite, 2u);
  EXPECT_EQ(faults.too_bright, 1u);
}

TEST(LightProduct, ZeroTimesInfinityIsZero) {
  EXPECT_EQ(light_product({0, 2, inf}, {inf, 3, 0}), (Color{0, 6, 0}));
  EXPECT_EQ(light_product({1, inf, 2}, {inf, 2, largest}), (Color{inf, inf, inf}));
}

TEST(DepthSums, CountsNaNSamples) {
  DepthSums sums;
  for (int run = 0; run < 2; ++run) {
    sums.start(3);
    sums.at_depth(0)[0] = sum_of(1);
    sums.at_depth(0)[1] = sum_of(1);
    sums.at_depth(1)[1] = {{0, nan, 0, 0}};  // NaN spoils this sample and no other
    sums.at_depth(1)[2] = sum_of(2);
    Color result[3];
    sums.finish(result);
    EXPECT_EQ(result[0], gray(1));
    EXPECT_EQ(result[1], gray(0));
    EXPECT_EQ(result[2], gray(2));
  }
  EXPECT_EQ(sums.faults().not_finite, 2u);
  EXPECT_EQ(sums.faults().too_bright, 0u);
}

TEST(DepthSums, SumDoesNotDependOnCallOrder) {
  // 2^24 + 1 rounds to 2^24, but 2^24 + 2 does not: the sum depends on its order.
  constexpr float big = 16777216;
  DepthSums sums;
  Color result;
  sums.start(1);
  sums.at_depth(2)[0] = sum_of(1);
  sums.at_depth(0)[0] = sum_of(1);
  sums.at_depth(1)[0] = sum_of(big);
  sums.finish(&result);
  EXPECT_EQ(result, gray((1 + big) + 1));
  sums.start(1);
  sums.at_depth(0)[0] = sum_of(1);
  sums.at_depth(1)[0] = sum_of(1);
  sums.finish_below(2);
  sums.at_depth(2)[0] = sum_of(big);
  sums.finish(&result);
  EXPECT_EQ(result, gray(big + 2));
}

TEST(DepthSums, OneRayPerDepthSumsAsMany) {
  constexpr float big = 16777216;
  const float found[][4] = {{1, big, 1, 0}, {0, -0.0F, 0, 3}, {inf, 1, 0, 0}, {inf, -inf, 1, 2}};
  Color results[2][4];
  for (const RaysPerDepth rays : {RaysPerDepth::many, RaysPerDepth::one_at_most}) {
    DepthSums sums(rays);
    sums.start(4);
    for (int depth = 0; depth < 4; ++depth) {
      sums.finish_below(depth);
      ColorSum* const row = sums.at_depth(depth);
      for (int k = 0; k < 4; ++k) {
        for (float& sum : row[k].rgb0) sum += found[k][depth];
      }
    }
    sums.finish(results[rays == RaysPerDepth::many ? 0 : 1]);
    EXPECT_EQ(sums.faults().not_finite, 1U);
    EXPECT_EQ(sums.faults().too_bright, 1U);
  }
  for (int k = 0; k < 4; ++k) EXPECT_EQ(results[0][k], results[1][k]);
}

TEST(DepthSums, StartForgetsEarlierSums) {
  DepthSums sums;
  sums.start(3);
  sums.at_depth(4)[2] = sum_of(9);
  sums.finish_below(2);
  sums.start(2);
  sums.at_depth(0)[1] = sum_of(5);
  Color result[2];
  sums.finish(result);
  EXPECT_EQ(result[0], gray(0));
  EXPECT_EQ(result[1], gray(5));
}

TEST(DepthSums, ClampsTheTotal) {
  DepthSums sums;
  Color result;
  sums.start(1);
  for (int depth = 0; depth < 3; ++depth) sums.at_depth(depth)[0] = sum_of(largest);
  sums.finish(&result);
  EXPECT_EQ(result, gray(largest));
  EXPECT_EQ(sums.faults().too_bright, 1u);
}

}  // namespace
}  // namespace boule
