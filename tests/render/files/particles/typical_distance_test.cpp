#include "render/files/particles/typical_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

double random_part(std::uint64_t& state) {
  state = state * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(state >> 11) * 0x1p-53;
}

std::vector<Vec3d> gas(std::size_t count, double size) {
  std::uint64_t state = count;
  std::vector<Vec3d> points(count);
  for (Vec3d& p : points) {
    p = {random_part(state) * size, random_part(state) * size, random_part(state) * size};
  }
  return points;
}

TEST(TypicalDistance, OfFewPoints) {
  EXPECT_EQ(typical_distance({}, serial_for), 0);
  EXPECT_EQ(typical_distance({{1, 2, 3}}, serial_for), 0);
  EXPECT_EQ(typical_distance({{1, 2, 3}, {1, 2, 3}}, serial_for), 0);
  EXPECT_EQ(typical_distance({{1, 2, 3}, {1, 2, 5}}, serial_for), 2);
  EXPECT_EQ(typical_distance({{1, 2, 3}, {1, 2, 5}, {1, 2, 3}}, serial_for), 2);
  EXPECT_EQ(typical_distance({{0, 0, 0}, {1e-200, 0, 0}}, serial_for), 1e-200);
  EXPECT_EQ(typical_distance({{0, 0, 0}, {1e200, 0, 0}}, serial_for), 1e200);
}

TEST(TypicalDistance, OfALatticeIsItsSpacing) {
  for (const int side : {3, 20, 80}) {
    std::vector<Vec3d> points;
    for (int i = 0; i < side * side * side; ++i) {
      points.push_back({i % side * 0.5, i / side % side * 0.5, i / side / side * 0.5});
    }
    EXPECT_EQ(typical_distance(points, serial_for), 0.5);
  }
}

// The median of all nearest distances in a gas of density n is (3 ln 2 / (4 pi n))^(1/3).
TEST(TypicalDistance, OfAGasMatchesItsDensity) {
  for (const std::size_t count : {std::size_t{16000}, std::size_t{500000}}) {
    const double expected = std::cbrt(3 * std::log(2.0) / (4 * 3.14159265 * double(count))) * 10;
    // A thousand samples of what varies by a third: 2 % for two deviations; borders add some.
    EXPECT_NEAR(typical_distance(gas(count, 10), serial_for), expected, 0.05 * expected);
  }
}

// Most of the particles lie 1000 times as densely: a grid of cells of one size would fail.
TEST(TypicalDistance, OfClustersIsThatOfMostParticles) {
  std::vector<Vec3d> points = gas(200000, 1000);
  for (const Vec3d& p : gas(300000, 1)) points.push_back(p + Vec3d{500, 500, 500});
  const double found = typical_distance(points, serial_for);
  EXPECT_GT(found, 0.008);
  EXPECT_LT(found, 0.02);
}

TEST(TypicalDistance, IsTheSameForAnyThreads) {
  const auto points = gas(300000, 1);
  const double serial = typical_distance(points, serial_for);
  for (const std::size_t threads : {2, 3, 7}) {
    EXPECT_EQ(typical_distance(points, test::threaded_for(threads)), serial);
  }
}

TEST(TypicalDistance, OfPointsAtOnePlaceEnds) {
  std::vector<Vec3d> points(100000, Vec3d{1, 1, 1});
  EXPECT_EQ(typical_distance(points, serial_for), 0);
  points.push_back({3, 1, 1});
  EXPECT_GE(typical_distance(points, serial_for), 0);
}

}  // namespace
}  // namespace boule
