#include "core/base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace boule {
namespace {

TEST(SerialFor, CallsEveryIndexOnceInOrder) {
  std::vector<std::size_t> seen;
  const ParallelFor loop = serial_for;
  loop(5, [&](std::size_t i) { seen.push_back(i); });
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(SerialFor, OfZeroCallsNothing) {
  serial_for(0, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace boule
