// The simulation of ranks against cases whose end is known.
#include "bench/rank_simulation.h"

#include <gtest/gtest.h>

namespace boule::bench {
namespace {

TEST(RankSimulation, OneRankTakesTheTimeOfAllBlocks) {
  SimulatedRun run;
  run.costs = {1, 2, 3, 4};
  const SimulatedEnd end = simulate(run);
  EXPECT_DOUBLE_EQ(end.seconds, 10);
  EXPECT_DOUBLE_EQ(end.efficiency, 1);
  EXPECT_EQ(end.letters, 0U);
}

/// 1000 equal blocks of a second and two ranks: the other one works as long, but for its letters.
TEST(RankSimulation, EqualBlocksAreHalvedBetweenTwo) {
  SimulatedRun run;
  run.costs.assign(1000, 1.0);
  run.ranks = 2;
  const SimulatedEnd end = simulate(run);
  EXPECT_GE(end.seconds, 500);
  EXPECT_LE(end.seconds, 502);
}

/// A block that takes as long as all others together bounds the end from below.
TEST(RankSimulation, NothingIsFasterThanTheLongestBlock) {
  SimulatedRun run;
  run.costs.assign(100, 0.1);
  run.costs.back() = 10;
  run.ranks = 8;
  const SimulatedEnd end = simulate(run);
  EXPECT_GE(end.seconds, 10);
  EXPECT_LE(end.seconds, 10 + 10.0 / 8 + 1);
}

/// The leader's link bounds it too: 64 blocks of a gigabyte through a gigabyte a second.
TEST(RankSimulation, NothingIsFasterThanTheLeadersLink) {
  SimulatedRun run;
  run.costs.assign(64, 0.001);
  run.block_bytes = 1e9;
  run.ranks = 64;
  EXPECT_GE(simulate(run).seconds, 63);
}

}  // namespace
}  // namespace boule::bench
