#include "core/math/monotone_cubic.h"

#include <gtest/gtest.h>

#include <vector>

namespace boule {
namespace {

const std::vector<TimedValue> bumps = {{0, 1}, {3, 4}, {4, 4}, {10, -2}, {11, -1.9}, {20, 7}};

TEST(MonotoneCubic, KeepsItsValuesAndIsConstantOutside) {
  for (const auto& [time, value] : bumps) EXPECT_EQ(monotone_cubic(bumps, time), value);
  EXPECT_EQ(monotone_cubic(bumps, -5), 1);
  EXPECT_EQ(monotone_cubic(bumps, 20.5), 7);
  const std::vector<TimedValue> one = {{4, 2.5}};
  for (const double time : {0.0, 4.0, 9.0}) EXPECT_EQ(monotone_cubic(one, time), 2.5);
}

TEST(MonotoneCubic, NeverOvershootsAndHasNoCorners) {
  const double h = 1e-4;
  for (double time = 0; time < 20; time += h) {
    const double before = monotone_cubic(bumps, time), after = monotone_cubic(bumps, time + h);
    if (time + h <= 3 || time >= 10) {
      EXPECT_LE(before, after);
    }
    if (time >= 3 && time + h <= 4) {
      EXPECT_EQ(before, 4);
    }
    if (time >= 4 && time + h <= 10) {
      EXPECT_GE(before, after);
    }
  }
  for (std::size_t i = 1; i + 1 < bumps.size(); ++i) {  // the slope on both sides of a value
    const double t = bumps[i].time, value = bumps[i].value;
    const double left = (value - monotone_cubic(bumps, t - h)) / h;
    const double right = (monotone_cubic(bumps, t + h) - value) / h;
    EXPECT_NEAR(left, right, 1e-2);
  }
}

TEST(MonotoneCubic, ReproducesLines) {
  const std::vector<TimedValue> line = {{1, 3}, {2, 5}, {5, 11}, {9, 19}};
  const std::vector<TimedValue> two = {{1, 3}, {9, 19}};
  for (double time = 1; time <= 9; time += 0.25) {
    EXPECT_DOUBLE_EQ(monotone_cubic(line, time), 2 * time + 1);
    EXPECT_DOUBLE_EQ(monotone_cubic(two, time), 2 * time + 1);
  }
}

/// The values of Steffen's formula, worked out by hand: slopes 0 at (1, 1) where the sign changes,
/// and at (2, 4) of (0, 0), (2, 4), (3, 10): chords 2 and 6, parabola (2 * 1 + 6 * 2) / 3 = 14 / 3,
/// limited to 2 * 2.
TEST(MonotoneCubic, UsesSteffensSlopes) {
  const std::vector<TimedValue> rising = {{0, 0}, {2, 4}, {3, 10}};
  // Hermite at the middle of [0, 2] with slopes 2 and 4: (0 + 4) / 2 + 2 (2 - 4) / 8.
  EXPECT_DOUBLE_EQ(monotone_cubic(rising, 1), 1.5);
  // And of [2, 3] with slopes 4 and 6: (4 + 10) / 2 + 1 (4 - 6) / 8.
  EXPECT_DOUBLE_EQ(monotone_cubic(rising, 2.5), 6.75);
  const std::vector<TimedValue> peak = {{0, 0}, {1, 1}, {2, 0}};
  EXPECT_DOUBLE_EQ(monotone_cubic(peak, 0.5), 0.5 + (1.0 - 0) / 8);
}

}  // namespace
}  // namespace boule
