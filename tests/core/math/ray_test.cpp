#include "core/math/ray.h"

#include <gtest/gtest.h>

namespace boule {
namespace {

TEST(Ray, DefaultsToUnboundedWithoutSource) {
  const Ray ray{};
  EXPECT_EQ(ray.tmin, 0);
  EXPECT_EQ(ray.tmax, std::numeric_limits<float>::infinity());
  EXPECT_EQ(ray.source, no_primitive);
  EXPECT_FALSE(ray.inside);
}

TEST(Ray, AMissIsInfinitelyFar) {
  const Hit miss{};
  EXPECT_EQ(miss.t, std::numeric_limits<double>::infinity());
  EXPECT_EQ(miss.id, no_primitive);
}

TEST(Segment, RunsFromOnePointToTheOther) {
  const Ray ray = segment({1, 2, 3}, {4, 6, 1});
  EXPECT_EQ(ray.org, (Vec3d{1, 2, 3}));
  EXPECT_EQ(ray.dir, (Vec3f{3, 4, -2}));
  EXPECT_EQ(ray.tmin, 0);
  EXPECT_EQ(ray.tmax, 1 - 0x1p-22f);
  EXPECT_EQ(ray.source, no_primitive);
}

TEST(Segment, RoundsOnlyItsDirection) {
  const Vec3d from{0.1, 1e6, -1.0 / 3}, to{0.7, 1e6 + 1e-7, 2};
  const Ray ray = segment(from, to);
  EXPECT_EQ(ray.org, from);
  EXPECT_EQ(ray.dir, vec_cast<float>(to - from));
  EXPECT_GT(ray.dir.y, 0);  // a float origin would have lost it
}

TEST(Segment, EndsShortOfTheFarPoint) {
  // However the direction is rounded, the point at tmax does not reach beyond the far end.
  const Vec3d to{0.7, 1.3, 1e-3};
  const Ray ray = segment({0, 0, 0}, to);
  EXPECT_LT(static_cast<double>(ray.dir.x) * static_cast<double>(ray.tmax), to.x);
  EXPECT_LT(static_cast<double>(ray.dir.y) * static_cast<double>(ray.tmax), to.y);
  EXPECT_LT(static_cast<double>(ray.dir.z) * static_cast<double>(ray.tmax), to.z);
}

}  // namespace
}  // namespace boule
