#include "render/frame/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace boule {
namespace {

TEST(Sampler, OneSampleIsThePixelCentre) {
  const Sampler sampler(1, 99);
  for (const int i : {0, 1, 17, 65534}) {
    const RasterPoint p = sampler.position(i, 2 * i % 100, 0);
    EXPECT_EQ(p.x, i + 0.5);
    EXPECT_EQ(p.y, 2 * i % 100 + 0.5);
  }
}

/// Rows and columns of the stratum that a sample of pixel (0, 0) lies in, found without the
/// sampler's arithmetic: row k holds floor(n(k+1)/m) - floor(nk/m) strata of the area 1/n.
std::pair<int, int> stratum_of(const RasterPoint& p, int n) {
  const int m = static_cast<int>(std::lround(std::sqrt(n)));
  int before = 0;
  for (int row = 0; row < m; ++row) {
    const int count = n * (row + 1) / m - n * row / m;
    if (p.y < static_cast<double>(before + count) / n) {
      EXPECT_GE(p.y, static_cast<double>(before) / n);
      return {row, static_cast<int>(std::floor(p.x * count))};
    }
    before += count;
  }
  ADD_FAILURE() << "y = " << p.y << " is outside of the pixel";
  return {-1, -1};
}

TEST(Sampler, EveryStratumHasOneSampleForAnyNumber) {
  for (int n = 2; n <= 70; ++n) {
    const Sampler sampler(n, 5);
    std::set<std::pair<int, int>> seen;
    for (int s = 0; s < n; ++s) {
      const RasterPoint p = sampler.position(0, 0, s);
      ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << n << " " << s;
      seen.insert(stratum_of(p, n));
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(n)) << n;
  }
}

TEST(Sampler, RowsDifferByOneStratumAtMost) {
  for (int n = 1; n <= 70; ++n) {
    const int m = static_cast<int>(std::lround(std::sqrt(n)));
    const Sampler sampler(n, 0);
    std::vector<int> rows(static_cast<std::size_t>(m));
    for (int s = 0; s < n; ++s) {
      const int row = stratum_of(sampler.position(0, 0, s), n).first;
      ASSERT_GE(row, 0);
      ++rows[static_cast<std::size_t>(row)];
    }
    for (const int count : rows) EXPECT_TRUE(count == n / m || count == (n + m - 1) / m) << n;
  }
}

TEST(Sampler, DependsOnPixelSampleCountAndSeedOnly) {
  const Sampler a(16, 1), again(16, 1), seeded(16, 2), finer(17, 1);
  const RasterPoint p = a.position(3, 4, 5);
  EXPECT_EQ(p.x, again.position(3, 4, 5).x);
  EXPECT_EQ(p.y, again.position(3, 4, 5).y);
  EXPECT_NE(p.x, seeded.position(3, 4, 5).x);
  EXPECT_NE(p.x, finer.position(3, 4, 5).x);
  EXPECT_NE(p.x - 3, a.position(4, 4, 5).x - 4);
  EXPECT_NE(p.x, a.position(3, 5, 5).x);
}

TEST(Sampler, AnEarlyStopHasSamplesAllOverThePixel) {
  for (const int n : {16, 64, 100, 256}) {
    const Sampler sampler(n, 3);
    int upper = 0;
    for (int s = 0; s < n / 4; ++s) upper += sampler.position(0, 0, s).y < 0.5 ? 1 : 0;
    EXPECT_NEAR(upper, n / 8.0, 1.5) << n;
  }
}

TEST(Sampler, TakesTheLargestNumber) {
  const int n = 2147483647;
  const Sampler sampler(n, 3);
  for (const int s : {0, 1, n / 2, n - 1}) {
    const RasterPoint p = sampler.position(7, 9, s);
    EXPECT_TRUE(p.x >= 7 && p.x <= 8 && p.y >= 9 && p.y <= 10) << s;
  }
}

}  // namespace
}  // namespace boule
