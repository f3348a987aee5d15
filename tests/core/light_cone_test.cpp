#include "core/light_cone.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(LightCone, HasTheSolidAngleOfTheSphere) {
  // 2 pi (1 - cos a), sin a = radius / distance = 3/5.
  const LightCone cone({1, 2, 3}, {1, 2, 8}, 3);
  EXPECT_NEAR(1 / cone.density(), 2 * 3.141592653589793 * (1 - 0.8), 1e-14);
  const LightCone far({0, 0, 0}, {1e9, 0, 0}, 1);
  EXPECT_NEAR(far.density() * 3.141592653589793 / 1e18, 1, 1e-12);
}

TEST(LightCone, IsNoneFromWithinOrOnTheSphere) {
  EXPECT_EQ(LightCone({0, 0, 1}, {0, 0, 0}, 2).density(), 0);
  EXPECT_EQ(LightCone({0, 0, 2}, {0, 0, 0}, 2).density(), 0);
  EXPECT_EQ(LightCone({0, 0, 0}, {0, 0, 0}, 2).density(), 0);
  EXPECT_FALSE(LightCone({0, 0, 1}, {0, 0, 0}, 2).meets({0, 0, 1}, inf));
}

/// Rays to a sphere must not be blocked by the sphere, as near its edge as they may pass, but by
/// anything a little nearer.
TEST(LightCone, WaysEndJustBeforeTheSphere) {
  CaseRandom random(3);
  for (int i = 0; i < 200000; ++i) {
    const auto radius = static_cast<float>(std::pow(10, random.uniform(-4, 4)));
    const Vec3f center = vec_cast<float>(random.direction() * std::pow(10, random.uniform(-1, 4)));
    const double distance = static_cast<double>(radius) * (1 + std::pow(10, random.uniform(-3, 4)));
    const Vec3d point = vec_cast<double>(center) + random.direction() * distance;
    const LightCone cone(point, vec_cast<double>(center), static_cast<double>(radius));
    ASSERT_GT(cone.density(), 0);
    const double u = i % 4 == 0 ? 1 - std::pow(2, random.uniform(-53, -1)) : random.uniform(0, 1);
    const Vec3d direction = cone.direction({u, random.uniform(0, 1)});
    EXPECT_NEAR(length(direction), 1, 1e-14);
    const Ray ray = cone.way(direction);
    const std::vector<Sphere> spheres = {{center, radius, 0}};
    EXPECT_FALSE(reference::any_hit(ray, spheres, {})) << i;
    if (u > 0.99) continue;  // there distances change quickly
    EXPECT_TRUE(cone.meets(direction, inf));
    const Hit hit = reference::closest_hit({point, ray.dir}, spheres, {});
    ASSERT_NE(hit.id, no_primitive) << i;
    EXPECT_NEAR(static_cast<double>(ray.tmax) / hit.t, 1, 2e-4) << i;
    EXPECT_TRUE(cone.meets(direction, hit.t * (1 + 1e-4)));
    EXPECT_FALSE(cone.meets(direction, hit.t * (1 - 1e-4)));
  }
}

}  // namespace
}  // namespace boule::test
