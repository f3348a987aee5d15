// Which blocks a team's workers get, and in what portions.
#include "render/team/block_dealer.h"

#include <gtest/gtest.h>

#include <numeric>

namespace boule::test {
namespace {

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 100U);
  return all;
}

TEST(BlockDealer, DealsEachBlockOnceAndInOrder) {
  for (const int workers : {1, 3, 64}) {
    BlockDealer dealer(numbers(1000));
    std::vector<std::uint32_t> dealt;
    while (dealer.left() > 0) {
      const auto portion = dealer.deal(1, workers);
      ASSERT_FALSE(portion.empty());
      dealt.insert(dealt.end(), portion.begin(), portion.end());
    }
    EXPECT_EQ(dealt, numbers(1000));
    EXPECT_TRUE(dealer.deal(1, workers).empty());
  }
}

TEST(BlockDealer, PortionsShrinkToOneBlockForEachThread) {
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

TEST(BlockDealer, AWorkerHasTheNextPortionBeforeItNeedsIt) {
  EXPECT_TRUE(BlockDealer::wants(0, 0));
  EXPECT_TRUE(BlockDealer::wants(40, 40));   // it has the first portion only
  EXPECT_FALSE(BlockDealer::wants(70, 30));  // it has both
  EXPECT_TRUE(BlockDealer::wants(30, 30));   // the first is done
  EXPECT_TRUE(BlockDealer::wants(1, 1));
}

}  // namespace
}  // namespace boule::test
