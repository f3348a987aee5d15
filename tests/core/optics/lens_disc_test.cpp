#include "core/optics/lens_disc.h"

#include <gtest/gtest.h>

#include "tests/support/case_random.h"
#include "tests/support/long_double_formulas.h"

namespace boule::test {
namespace {

TEST(LensDisc, EqualsLongDouble) {
  CaseRandom random(43);
  for (int i = 0; i < 200000; ++i) {
    // Anywhere, on the diagonals where the formula changes, and on the rim.
    const double x = i % 7 == 0 ? 1 : random.uniform();
    const double y = i % 3 == 0 ? x : i % 3 == 1 ? 1 - x : random.uniform();
    const DiscPointOf<double> disc = disc_point(x, y);
    const DiscPointL wanted = disc_point_l(2.0L * x - 1, 2.0L * y - 1);
    ASSERT_NEAR(disc.x, static_cast<double>(wanted.x), 4e-16) << x << " " << y;
    ASSERT_NEAR(disc.y, static_cast<double>(wanted.y), 4e-16) << x << " " << y;
  }
}

TEST(LensDisc, KeepsTheCentre) {
  const DiscPointOf<double> middle = disc_point(0.5, 0.5);
  EXPECT_EQ(middle.x, 0);
  EXPECT_EQ(middle.y, 0);
}

}  // namespace
}  // namespace boule::test
