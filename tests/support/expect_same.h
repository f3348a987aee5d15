#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "core/math/vec.h"

namespace boule::test {

/// Expects equal bits, or two NaNs.
inline void expect_same(double a, double b) {
  if (a != a && b != b) return;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << ", " << b;
}
inline void expect_same(const Vec3d& a, const Vec3d& b) {
  expect_same(a.x, b.x);
  expect_same(a.y, b.y);
  expect_same(a.z, b.z);
}

}  // namespace boule::test
