// The oracle itself, on cases whose answers are known in closed form.
#include "tests/oracle/oracle.h"

#include <gtest/gtest.h>

#include <vector>

namespace boule::test {
namespace {

TEST(Oracle, KnowsRationalRoots) {
  const Ray ray{{0, 0, 0}, {0, 0, -2}};
  const auto hit = oracle_hit(ray, Sphere{{3, 0, -8}, 5, 0});  // 3-4-5: at z = -4 and -12
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t.to_double(), 2);
  EXPECT_EQ(hit->other->to_double(), 6);
  EXPECT_EQ(oracle_residual(ray, Sphere{{3, 0, -8}, 5, 0}, 2).sign(), 0);
  EXPECT_EQ(oracle_residual(ray, Sphere{{3, 0, -8}, 5, 0}, 4).to_double(), -2);
  const auto plane = oracle_hit(ray, Plane{{7, 7, -8}, {0, 0, 3}, 0});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->t.to_double(), 4);
  EXPECT_EQ(oracle_residual(ray, Plane{{7, 7, -8}, {0, 0, 3}, 0}, 3).to_double(), 2);
}

TEST(Oracle, ResolvesTheSmallestStepAtTheRim) {
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  const float beside = 0x1p100f, next = 0x1.000002p100f;
  EXPECT_TRUE(oracle_hit(ray, Sphere{{beside, 0, -0x1p120f}, beside, 0}));
  EXPECT_FALSE(oracle_hit(ray, Sphere{{next, 0, -0x1p120f}, beside, 0}));
  // And where only the last of 250 bits differs: a denormal beside a huge offset.
  EXPECT_TRUE(oracle_hit({{1e-45, 0, 0}, {0, 0, -1}}, Sphere{{beside, 0, -1}, beside, 0}));
  EXPECT_FALSE(oracle_hit({{-1e-45, 0, 0}, {0, 0, -1}}, Sphere{{beside, 0, -1}, beside, 0}));
}

TEST(Oracle, BoundsAreOpenBelowAndClosedAbove) {
  const Sphere sphere{{0, 0, -5}, 1, 0};
  Ray ray{{0, 0, 0}, {0, 0, -1}, 4, 6};
  ASSERT_TRUE(oracle_hit(ray, sphere));
  EXPECT_EQ(oracle_hit(ray, sphere)->t.to_double(), 6);
  ray.tmax = 5.9999995f;
  EXPECT_FALSE(oracle_hit(ray, sphere));
  ray = {{0, 0, 0}, {0, 0, -0x1p-126f}};
  EXPECT_FALSE(oracle_hit(ray, Sphere{{0, 0, -16}, 1, 0}));  // t is 15 * 2^126
}

TEST(Oracle, TiesGoToTheLowerId) {
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  const Sphere far{{0, 0, -9}, 1, 0}, near{{0, 0, -5}, 1, 0};
  const Plane wall{{0, 0, -4}, {0, 0, 1}, 0};
  EXPECT_EQ(oracle_closest(ray, std::vector<Sphere>{far, near, near}, std::vector<Plane>{wall}), 1);
  EXPECT_EQ(oracle_closest(ray, std::vector<Sphere>{far}, std::vector<Plane>{wall, wall}), 1);
  EXPECT_EQ(oracle_closest(ray, {}, {}), no_primitive);
}

}  // namespace
}  // namespace boule::test
