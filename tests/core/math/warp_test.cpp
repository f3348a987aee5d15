#include "core/math/warp.h"

#include <gtest/gtest.h>

#include "core/math/geometry.h"
#include "core/math/sobol.h"
#include "tests/support/case_random.h"
#include "tests/support/long_double_formulas.h"

namespace boule {
namespace {

TEST(Warp, TurnsAreAnglesToFullPrecision) {
  for (int i = 0; i <= 4096; ++i) {
    const double turns = i / 4096.0;
    const Angle angle = full_turns(turns);
    EXPECT_NEAR(angle.cosine, std::cos(2 * elementary::pi * turns), 1e-15) << turns;
    EXPECT_NEAR(angle.sine, std::sin(2 * elementary::pi * turns), 1e-15) << turns;
  }
}

TEST(Warp, DirectionsEqualLongDouble) {
  test::CaseRandom random(44);
  for (int i = 0; i < 200000; ++i) {
    const Vec3d poles[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, -0.0}, {0, 1, 0}};
    const Vec3d axis = i % 7 == 0 ? poles[i % 4] : random.direction();
    const double u = i % 5 == 0 ? 0 : random.uniform();
    const double turns = random.uniform();
    const Angle from = warp_to_cosine(u);
    const Vec3d direction = direction_about(axis, from, turns);
    const test::Vec3l wanted = test::direction_about_l(
        axis, std::asin(std::sqrt(static_cast<long double>(u))), 2 * test::pi_l * turns);
    ASSERT_LE(test::length(vec_cast<long double>(direction) - wanted), 1e-15L) << i;
  }
}

TEST(Warp, Atan2EqualsTheStandardLibrarys) {
  EXPECT_EQ(elementary::atan2(0, 0), 0);
  EXPECT_EQ(elementary::atan2(0, -2), elementary::pi);
  for (int i = -4096; i <= 4096; ++i) {
    const double angle = elementary::pi * i / 4096;
    for (const double size : {1e-200, 1.0, 1e200}) {
      const double x = std::cos(angle) * size, y = std::sin(angle) * size;
      EXPECT_NEAR(elementary::atan2(y, x), std::atan2(y, x), 1e-15) << i;
    }
  }
}

TEST(Warp, DirectionsHaveTheRequestedAngle) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const auto [a, b] = sobol_pair(1, RandomSet::film, i);
    const Vec3d axis = direction_about({0, 0, i % 2 == 0 ? 1.0 : -1.0}, warp_to_cone(a, 1.5), b);
    EXPECT_NEAR(length(axis), 1, 1e-14);
    const Angle from = warp_to_cone(b, 2.0);
    const Vec3d direction = direction_about(axis, from, a);
    EXPECT_NEAR(dot(axis, direction), from.cosine, 1e-14);
    EXPECT_NEAR(length(direction), 1, 1e-14);
  }
}

/// Mean of g(cosine) over samples of a density against its integral over the sphere.
template <class Warp, class Density>
void expect_density(const Warp& warp, const Density& density, double lowest) {
  constexpr int n = 16384;
  for (const int power : {0, 1, 2, 3}) {
    double mean = 0, integral = 0;
    for (int i = 0; i < n; ++i) {
      mean += std::pow(warp((i + 0.5) / n).cosine, power) / n;
      const double cosine = lowest + (1 - lowest) * (i + 0.5) / n;
      integral += std::pow(cosine, power) * density(cosine) * 2 * elementary::pi * (1 - lowest) / n;
    }
    EXPECT_NEAR(mean, integral, 2e-4) << power;
  }
}

TEST(Warp, SamplesFollowTheirDensities) {
  expect_density([](double u) { return warp_to_cosine(u); },
                 [](double c) { return cosine_density(c); }, 0);
  for (const double n : {0.5, 1.0, 7.5, 60.0}) {
    expect_density([&](double u) { return warp_to_power(u, n); },
                   [&](double c) { return power_density(std::pow(c, n), n); }, 0);
  }
  for (const double height : {1e-3, 0.5, 1.0}) {
    expect_density([&](double u) { return warp_to_cone(u, height); },
                   [&](double) { return cone_density(height); }, 1 - height);
  }
}

TEST(Warp, NarrowConesKeepTheirShape) {
  for (const double height : {1e-10, 1e-16, 1e-30}) {
    const Angle edge = warp_to_cone(1.0, height);
    EXPECT_NEAR(edge.sine / std::sqrt(2 * height), 1, 1e-9);
  }
}

}  // namespace
}  // namespace boule
