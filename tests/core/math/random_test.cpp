#include "core/math/random.h"

#include <vector>

#include <gtest/gtest.h>

namespace boule {
namespace {

using Counter = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

// Random123's known-answer vectors for philox4x32-10 (kat_vectors).
TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_EQ(philox(Counter{0, 0, 0, 0}, Key{0, 0}),
            (Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox(Counter{ones, ones, ones, ones}, Key{ones, ones}),
            (Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(
      philox(Counter{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, Key{0xa4093822, 0x299f31d0}),
      (Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The first outputs of SplitMix64 seeded with 1234567 (Vigna's splitmix64.c): mix64 of a counter.
TEST(Mix64, GivesTheKnownAnswers) {
  std::uint64_t counter = 1234567;
  for (const std::uint64_t expected :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U}) {
    counter += golden_step;
    EXPECT_EQ(mix64(counter), expected);
  }
}

TEST(UnitInterval, CoversZeroToBelowOne) {
  EXPECT_EQ(unit_interval(0), 0);
  EXPECT_EQ(unit_interval(1), 0x1p-32);
  EXPECT_EQ(unit_interval(0x80000000), 0.5);
  EXPECT_EQ(unit_interval(0xffffffff), 1 - 0x1p-32);
}

TEST(Philox, EveryInputWordChangesTheOutput) {
  const Counter counter{1, 2, 3, 4};
  const Key key{5, 6};
  const auto base = philox(counter, key);
  EXPECT_EQ(philox(counter, key), base);
  for (std::size_t i = 0; i < counter.size(); ++i) {
    Counter other = counter;
    ++other[i];
    EXPECT_NE(philox(other, key), base);
  }
  EXPECT_NE(philox(counter, Key{6, 6}), base);
  EXPECT_NE(philox(counter, Key{5, 7}), base);
  EXPECT_NE(philox(Counter{2, 1, 3, 4}, key), base);
}

TEST(Philox, FillsTheIntervalEvenly) {
  // 64 bins of 4 x 16384 numbers: 1024 each, standard deviation 32; six of them allowed.
  std::vector<int> bins(64);
  for (std::uint32_t sample = 0; sample < 16384; ++sample) {
    for (const std::uint32_t word : philox(Counter{17, 4, sample, 0}, Key{1, 0})) {
      const double x = unit_interval(word);
      ASSERT_GE(x, 0);
      ASSERT_LT(x, 1);
      ++bins[static_cast<std::size_t>(x * 64)];
    }
  }
  for (const int count : bins) EXPECT_NEAR(count, 1024, 6 * 32);
}

}  // namespace
}  // namespace boule
