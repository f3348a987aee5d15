#include "core/math/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace boule {
namespace {

constexpr RandomSet other_set{7};

/// The second Sobol dimension by its definition: the direction numbers of the polynomial x + 1,
/// v_1 = 1/2, v_k = v_(k-1) xor v_(k-1)/2 (Bratley and Fox 1988), as 32-bit fractions.
std::uint32_t sobol_by_direction_numbers(std::uint32_t index) {
  std::uint32_t sum = 0;
  for (std::uint32_t v = 0x80000000U; index != 0; index >>= 1, v ^= v >> 1) {
    if ((index & 1) != 0) sum ^= v;
  }
  return sum;
}

TEST(Sobol, SecondDimensionIsTheSobolSequences) {
  for (std::uint32_t i = 0; i < 5000; ++i) {
    for (const std::uint32_t index : {i, i * 2654435761U}) {
      EXPECT_EQ(detail::reverse_bits(detail::pascal(index)), sobol_by_direction_numbers(index));
    }
  }
}

TEST(Sobol, ReversesBits) {
  EXPECT_EQ(detail::reverse_bits(1U), 0x80000000U);
  EXPECT_EQ(detail::reverse_bits(0x12345678U), 0x1e6a2c48U);
}

/// Owen's scrambling: two fractions that agree in their first k digits, and no more, do so
/// afterwards. Digits run from bit 0 on.
TEST(Scramble, PreservesCommonPrefixes) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto a = static_cast<std::uint32_t>(mix64(i)), seed = static_cast<std::uint32_t>(i * 77);
    for (int k = 0; k < 32; ++k) {
      const std::uint32_t b = a ^ (1U << k) ^ ((a * 31) & ~((2U << k) - 1));
      const std::uint32_t differ = detail::scramble(a, seed) ^ detail::scramble(b, seed);
      ASSERT_EQ(differ & ((2U << k) - 1), 1U << k) << a << " " << seed << " " << k;
    }
  }
}

/// Points in each cell of a grid of 2^a by 2^b.
std::vector<int> count_cells(const std::vector<UnitPair>& points, int a, int b) {
  std::vector<int> counts(std::size_t{1} << (a + b));
  for (const auto& [u, v] : points) {
    const auto column = static_cast<std::size_t>(std::ldexp(u, a));
    const auto row = static_cast<std::size_t>(std::ldexp(v, b));
    ++counts.at((row << a) + column);
  }
  return counts;
}

TEST(Sobol, PointsFillEveryDyadicGridEvenly) {
  for (const std::uint64_t key : {0U, 1U, 99U}) {
    std::vector<UnitPair> points;
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
      points.push_back(sobol_pair(key, RandomSet::film, sample));
      const auto n = static_cast<int>(points.size());
      for (int bits = 0; bits <= 9; ++bits) {
        for (int a = 0; a <= bits; ++a) {
          const std::vector<int> counts = count_cells(points, a, bits - a);
          const auto [fewest, most] = std::minmax_element(counts.begin(), counts.end());
          ASSERT_GE(*fewest, n >> bits) << n << " points, 2^" << a << " by 2^" << bits - a;
          ASSERT_LE(*most, (n + (1 << bits) - 1) >> bits) << n;
        }
      }
    }
  }
}

/// Where two pixels' points lie has nothing in common: over many pixels each sample's place is
/// uniform, and so are the pairs of two samples' places, as far as stratification lets them.
TEST(Sobol, EachPointIsUniformOverThePixels) {
  constexpr int pixels = 20000, cells = 16;
  for (const std::uint32_t sample : {0U, 1U, 6U, 1000000000U}) {
    for (const RandomSet set : {RandomSet::film, other_set}) {
      double counts_u[cells] = {}, counts_v[cells] = {}, product = 0;
      for (int i = 0; i < pixels; ++i) {
        const auto [u, v] = sobol_pair(PixelKeys(1).of(i % 200, i / 200), set, sample);
        ++counts_u[static_cast<int>(u * cells)];
        ++counts_v[static_cast<int>(v * cells)];
        product += (u - 0.5) * (v - 0.5);
      }
      const auto chi_squared = [&](const double* counts) {
        double sum = 0;
        constexpr double expected = double{pixels} / cells;
        for (int k = 0; k < cells; ++k) sum += std::pow(counts[k] - expected, 2) / expected;
        return sum;
      };
      EXPECT_LT(chi_squared(counts_u), 44) << sample;  // 15 degrees of freedom: 1 in 10,000
      EXPECT_LT(chi_squared(counts_v), 44) << sample;
      // The product's mean has a standard deviation of 1/12 / sqrt(n).
      EXPECT_LT(std::fabs(product / pixels), 4 / 12.0 / std::sqrt(double{pixels})) << sample;
    }
  }
}

/// Sets are padded: sample i of one must say nothing about sample i of the other.
TEST(Sobol, SetsAreIndependent) {
  constexpr int pixels = 200, samples = 64;
  double sums[4] = {};
  for (int i = 0; i < pixels; ++i) {
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      const auto [a, b] = sobol_pair(PixelKeys(1).of(i, 3), RandomSet::film, sample);
      const auto [c, d] = sobol_pair(PixelKeys(1).of(i, 3), other_set, sample);
      sums[0] += (a - 0.5) * (c - 0.5);
      sums[1] += (a - 0.5) * (d - 0.5);
      sums[2] += (b - 0.5) * (c - 0.5);
      sums[3] += (b - 0.5) * (d - 0.5);
    }
  }
  for (const double sum : sums) {
    EXPECT_LT(std::fabs(sum / (pixels * samples)), 4 / 12.0 / std::sqrt(double{pixels} * samples));
  }
}

/// A smooth integrand: n samples do as well as n^-1.5 promises (Owen 1997), far better than n^-0.5.
TEST(Sobol, ErrorFallsFasterThanRandomSamples) {
  const auto rms_error = [](std::uint32_t n) {
    double sum = 0;
    for (int pixel = 0; pixel < 400; ++pixel) {
      double mean = 0;
      for (std::uint32_t sample = 0; sample < n; ++sample) {
        const auto [u, v] = sobol_pair(PixelKeys(2).of(pixel, 5), RandomSet::film, sample);
        mean += u * v / n;
      }
      sum += (mean - 0.25) * (mean - 0.25);
    }
    return std::sqrt(sum / 400);
  };
  const double slope = std::log2(rms_error(1024) / rms_error(16)) / 6;
  EXPECT_LT(slope, -1.3);
}

TEST(PixelKeys, DifferWithEveryArgument) {
  const std::uint64_t base = PixelKeys(5).of(3, 4);
  EXPECT_EQ(PixelKeys(5).of(3, 4), base);
  for (const std::uint64_t other :
       {PixelKeys(5).of(4, 3), PixelKeys(5).of(4, 4), PixelKeys(5).of(3, 5), PixelKeys(6).of(3, 4),
        PixelKeys(5 + (1ULL << 40)).of(3, 4)}) {
    EXPECT_NE(other, base);
  }
}

}  // namespace
}  // namespace boule
