#include "core/math/vec.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/math/color.h"
#include "core/math/geometry.h"

namespace boule::vec {
namespace {

const Vec3d x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

TEST(Vec3, Arithmetic) {
  const Vec3f a{1, 2, 3}, b{10, 20, 40};
  EXPECT_EQ(a + b, (Vec3f{11, 22, 43}));
  EXPECT_EQ(b - a, (Vec3f{9, 18, 37}));
  EXPECT_EQ(-a, (Vec3f{-1, -2, -3}));
  EXPECT_EQ(a * 3.0f, (Vec3f{3, 6, 9}));
  EXPECT_EQ(dot(a, b), 170);
  EXPECT_EQ(Vec3d{}, (Vec3d{0, 0, 0}));
}

/// GCC 12's SLP vectoriser takes this for nothing at all, if it is let (CMakeLists.txt).
[[gnu::noinline]] Vec3d there_and_back(const Vec3d& v) {
  return vec_cast<double>(vec_cast<float>(v));
}

TEST(Vec3, CastsRoundEveryComponent) {
  const double third = 1.0 / 3, rounded = 0x1.555556p-2;
  EXPECT_EQ(there_and_back({third, 2 * third, 4 * third}),
            (Vec3d{rounded, 2 * rounded, 4 * rounded}));
}

TEST(Vec3, EqualityLooksAtEveryComponent) {
  const Vec3f a{1, 2, 3};
  EXPECT_TRUE(a == (Vec3f{1, 2, 3}));
  EXPECT_FALSE(a == (Vec3f{9, 2, 3}));
  EXPECT_FALSE(a == (Vec3f{1, 9, 3}));
  EXPECT_FALSE(a == (Vec3f{1, 2, 9}));
}

TEST(Vec3, CrossIsRightHanded) {
  EXPECT_EQ(cross(x_axis, y_axis), z_axis);
  EXPECT_EQ(cross(y_axis, z_axis), x_axis);
  EXPECT_EQ(cross(z_axis, x_axis), y_axis);
  EXPECT_EQ(cross(Vec3d{1, 2, 3}, Vec3d{5, 7, 11}), (Vec3d{1, 4, -3}));
}

TEST(Vec3, DotAddsInTheStatedOrder) {
  // (1 + 2^-53) + 2^-53 is 1; any other order gives more.
  constexpr double half_ulp = 0x1p-53;
  EXPECT_EQ(dot(Vec3d{1, half_ulp, half_ulp}, Vec3d{1, 1, 1}), 1);
  EXPECT_EQ(dot(Vec3d{half_ulp, half_ulp, 1}, Vec3d{1, 1, 1}), 1 + 0x1p-52);
}

TEST(Vec3, DotRoundsEveryProduct) {
  // x x - 1 with x = 1 + 2^-30: fused it would keep the 2^-60.
  constexpr double x = 1 + 0x1p-30;
  EXPECT_EQ(dot(Vec3d{x, 1, 0}, Vec3d{x, -1, 0}), 0x1p-29);
}

TEST(VecCast, RoundsToNearest) {
  EXPECT_EQ(vec_cast<double>(Vec3f{0.1f, -2, 3}), (Vec3d{static_cast<double>(0.1f), -2, 3}));
  EXPECT_EQ(vec_cast<float>(Vec3d{0.1, 1 + 0x1p-25, 1 + 0x1.8p-24}),
            (Vec3f{0.1f, 1, 1 + 0x1p-23f}));
}

TEST(Geometry, LengthAndNormalize) {
  EXPECT_EQ(length({3, 4, 12}), 13);
  EXPECT_EQ(normalize({0, 0, -8}), (Vec3d{0, 0, -1}));
  EXPECT_NEAR(length(normalize({1, 2, 3})), 1, 0x1p-51);
  EXPECT_TRUE(std::isnan(normalize({0, 0, 0}).x));
}

TEST(Geometry, FiniteMeansEveryComponent) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(is_finite(Vec3d{1, -1e308, 0}));
  EXPECT_FALSE(is_finite(Vec3d{inf, 0, 0}));
  EXPECT_FALSE(is_finite(Vec3d{0, -inf, 0}));
  EXPECT_FALSE(is_finite(Vec3f{0, 0, nan}));
}

TEST(Color, Arithmetic) {
  const Color a{1, 2, 4}, b{0.5f, 0.25f, 2};
  EXPECT_EQ(a + b, (Color{1.5f, 2.25f, 6}));
  EXPECT_EQ(a * b, (Color{0.5f, 0.5f, 8}));
  EXPECT_EQ(a * 2.0f, (Color{2, 4, 8}));
  EXPECT_EQ(gray(0.5f), (Color{0.5f, 0.5f, 0.5f}));
  EXPECT_TRUE(is_black({0, 0, 0}));
  EXPECT_FALSE(is_black({0, 0, 0x1p-149f}));
  EXPECT_FALSE(is_black({0, 1, 0}));
  EXPECT_FALSE(is_black({1, 0, 0}));
}

}  // namespace
}  // namespace boule::vec
