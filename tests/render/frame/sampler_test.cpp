#include "render/frame/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/math/random.h"

namespace boule {
namespace {

TEST(Sampler, OneSampleIsThePixelCentre) {
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::tent}) {
    const Sampler sampler(1, 99, filter);
    for (const int i : {0, 1, 17, 65534}) {
      const RasterPoint p = sampler.position({i, 2 * i % 100, 0});
      EXPECT_EQ(p.x, i + 0.5);
      EXPECT_EQ(p.y, 2 * i % 100 + 0.5);
    }
  }
}

/// Any number n of samples is stratified: every cell of every dyadic grid has its share of them,
/// rounded up or down.
TEST(Sampler, StrataGetEqualSharesOfSamples) {
  for (int n = 2; n <= 70; ++n) {
    const Sampler sampler(n, 5);
    for (const auto& [columns, rows] : {std::pair{2, 1},
                                        {1, 2},
                                        {4, 1},
                                        {1, 4},
                                        {2, 2},
                                        {4, 4},
                                        {8, 2},
                                        {2, 8},
                                        {16, 1},
                                        {1, 16},
                                        {8, 8}}) {
      const int cells = columns * rows;
      std::vector<int> counts(static_cast<std::size_t>(cells));
      for (int s = 0; s < n; ++s) {
        const RasterPoint p = sampler.position({0, 0, s});
        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << n << " " << s;
        ++counts[static_cast<std::size_t>(static_cast<int>(p.y * rows) * columns +
                                          static_cast<int>(p.x * columns))];
      }
      for (const int count : counts) {
        EXPECT_GE(count, n / cells) << n;
        EXPECT_LE(count, (n + cells - 1) / cells) << n;
      }
    }
  }
}

/// The standard error of n samples for edges through the pixel, from one side to the opposite one.
template <class Place>
double edge_error(int n, const Place& place) {
  constexpr int edges = 8000;
  double sum = 0;
  for (int i = 0; i < edges; ++i) {
    const std::uint64_t words = mix64(golden_step * static_cast<unsigned>(i));
    const double from = unit_interval(static_cast<std::uint32_t>(words));
    const double to = unit_interval(static_cast<std::uint32_t>(words >> 32));
    // An edge from (from, 0) to (to, 1), or its mirror image in the diagonal: the area before it is
    // (from + to) / 2.
    int before = 0;
    for (int s = 0; s < n; ++s) {
      const RasterPoint p = place(i % 100, i / 100, s);
      const auto [across, along] = i % 2 == 0 ? std::pair{p.x, p.y} : std::pair{p.y, p.x};
      before += across < from + (to - from) * along ? 1 : 0;
    }
    sum += std::pow(static_cast<double>(before) / n - (from + to) / 2, 2);
  }
  return std::sqrt(sum / edges);
}

/// The same for jittered samples, the usual way to take any number of them: one random sample in
/// each of n strata of area 1/n, in round(sqrt(n)) rows of about equal counts.
double jittered_error(int n) {
  const int m = static_cast<int>(std::lround(std::sqrt(n)));
  return edge_error(n, [&](int x, int y, int s) {
    const int row = ((s + 1) * m - 1) / n, first = n * row / m, end = n * (row + 1) / m;
    const std::uint64_t words =
        mix64(golden_step * static_cast<unsigned>(1 + s + 1000 * (x + 256 * y)));
    const double u = unit_interval(static_cast<std::uint32_t>(words));
    const double v = unit_interval(static_cast<std::uint32_t>(words >> 32));
    return RasterPoint{(s - first + u) / (end - first), (first + (end - first) * v) / n};
  });
}

TEST(Sampler, EdgesAreAsSmoothAsJittered) {
  for (int n = 2; n <= 40; ++n) {
    const Sampler sampler(n, 5);
    const double error = edge_error(n, [&](int x, int y, int s) {
      const RasterPoint p = sampler.position({x, y, s});
      return RasterPoint{p.x - x, p.y - y};
    });
    EXPECT_LE(error, 1.03 * jittered_error(n)) << n;  // with 8000 edges it is known to 1 %
  }
}

TEST(Sampler, DependsOnPixelSampleAndSeedOnly) {
  const Sampler a(16, 1), again(16, 1), seeded(16, 2), finer(17, 1);
  const RasterPoint p = a.position({3, 4, 5});
  EXPECT_EQ(p.x, again.position({3, 4, 5}).x);
  EXPECT_EQ(p.y, again.position({3, 4, 5}).y);
  EXPECT_NE(p.x, seeded.position({3, 4, 5}).x);
  EXPECT_EQ(p.x, finer.position({3, 4, 5}).x);
  EXPECT_NE(p.x - 3, a.position({4, 4, 5}).x - 4);
  EXPECT_NE(p.x, a.position({3, 5, 5}).x);
}

TEST(Sampler, PrefixesCoverTheWholePixel) {
  for (const int n : {16, 64, 100, 256}) {
    const Sampler sampler(n, 3);
    int upper = 0;
    for (int s = 0; s < n / 4; ++s) upper += sampler.position({0, 0, s}).y < 0.5 ? 1 : 0;
    EXPECT_NEAR(upper, n / 8.0, 0.5) << n;
  }
}

TEST(Sampler, TakesTheLargestNumber) {
  const int n = 2147483647;
  const Sampler sampler(n, 3);
  for (const int s : {0, 1, n / 2, n - 1}) {
    const RasterPoint p = sampler.position({7, 9, s});
    EXPECT_TRUE(p.x >= 7 && p.x <= 8 && p.y >= 9 && p.y <= 10) << s;
  }
}

/// Left of x <= 0 lies the share (1 + x)^2 / 2 of a tent's area over -1 .. 1, and so of the
/// samples.
TEST(Sampler, TentSamplesAreDistributedAsTheTent) {
  const int n = 4096;
  const Sampler sampler(n, 3, PixelFilter::tent);
  for (const double x : {-0.9, -0.5, -0.2, 0.0}) {
    int left = 0, right = 0, above = 0, below = 0;
    for (int s = 0; s < n; ++s) {
      const RasterPoint p = sampler.position({20, 30, s});
      ASSERT_TRUE(std::fabs(p.x - 20.5) <= 1 && std::fabs(p.y - 30.5) <= 1);
      left += p.x - 20.5 < x ? 1 : 0;
      right += p.x - 20.5 > -x ? 1 : 0;
      above += p.y - 30.5 < x ? 1 : 0;
      below += p.y - 30.5 > -x ? 1 : 0;
    }
    const double share = n * (1 + x) * (1 + x) / 2;
    for (const int count : {left, right, above, below}) EXPECT_NEAR(count, share, 1) << x;
  }
}

}  // namespace
}  // namespace boule
