// Which blocks a team's workers get, and in what portions.
#include "render/apps/team/block_dealer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace boule::test {
namespace {

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 100U);
  return all;
}

TEST(BlockDealer, DealsEachBlockOnce) {
  for (const int workers : {1, 3, 64}) {
    BlockDealer dealer(numbers(1000));
    std::vector<std::uint32_t> dealt;
    while (dealer.left() > 0) {
      const auto portion = dealer.deal(1, workers);
      ASSERT_FALSE(portion.empty());
      dealt.insert(dealt.end(), portion.begin(), portion.end());
    }
    std::sort(dealt.begin(), dealt.end());
    EXPECT_EQ(dealt, numbers(1000));
    EXPECT_TRUE(dealer.deal(1, workers).empty());
  }
}

TEST(BlockDealer, PortionsShrinkToOneBlockPerThread) {
  BlockDealer dealer(numbers(10'000));
  std::size_t before = 10'000, portions = 0;
  while (dealer.left() > 0) {
    const std::size_t size = dealer.deal(2, 20).size();
    EXPECT_LE(size, before);
    before = size;
    ++portions;
  }
  EXPECT_LE(before, 2U);
  EXPECT_LT(portions, 300U);
}

/// The first eighth has an eighth of each quarter of the list.
TEST(BlockDealer, APortionIsSpreadOverThePicture) {
  BlockDealer dealer(numbers(1024));
  const auto portion = dealer.deal(1, 2);
  ASSERT_EQ(portion.size(), 128U);
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    EXPECT_EQ(std::count_if(portion.begin(), portion.end(),
                            [&](std::uint32_t block) { return (block - 100) / 256 == quarter; }),
              32);
  }
}

TEST(BlockDealer, WorkersHoldTheirNextPortionEarly) {
  BlockDealer dealer(numbers(10));
  EXPECT_TRUE(dealer.wants(0, 0, 1, 4));
  EXPECT_TRUE(dealer.wants(40, 40, 1, 4));   // it has the first portion only
  EXPECT_FALSE(dealer.wants(70, 30, 1, 4));  // it has both
  EXPECT_TRUE(dealer.wants(30, 30, 1, 4));   // the first is done
  EXPECT_TRUE(dealer.wants(1, 1, 1, 4));
}

TEST(BlockDealer, IdleWorkersGetTheLastBlocks) {
  BlockDealer dealer(numbers(4));
  EXPECT_FALSE(dealer.wants(1, 1, 1, 4));
  EXPECT_TRUE(dealer.wants(0, 1, 1, 4));
  EXPECT_TRUE(dealer.wants(1, 1, 2, 4));
}

}  // namespace
}  // namespace boule::test
