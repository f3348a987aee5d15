#include "core/math/light_cone.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "tests/support/case_random.h"
#include "tests/support/long_double_formulas.h"

namespace boule::test::light_cone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(LightCone, HasTheSolidAngleOfTheSphere) {
  // 2 pi (1 - cos a), sin a = radius / distance = 3/5.
  const LightCone cone({1, 2, 3}, {1, 2, 8}, 3);
  EXPECT_NEAR(1 / cone.density(), 2 * 3.141592653589793 * (1 - 0.8), 1e-14);
  const LightCone far({0, 0, 0}, {1e9, 0, 0}, 1);
  EXPECT_NEAR(far.density() * 3.141592653589793 / 1e18, 1, 1e-12);
}

TEST(LightCone, IsAbsentInsideOrOnTheSphere) {
  EXPECT_EQ(LightCone({0, 0, 1}, {0, 0, 0}, 2).density(), 0);
  EXPECT_EQ(LightCone({0, 0, 2}, {0, 0, 0}, 2).density(), 0);
  EXPECT_EQ(LightCone({0, 0, 0}, {0, 0, 0}, 2).density(), 0);
  EXPECT_FALSE(LightCone({0, 0, 1}, {0, 0, 0}, 2).meets({0, 0, 1}, inf));
}

TEST(LightCone, EqualsLongDouble) {
  CaseRandom random(45);
  for (int i = 0; i < 200000; ++i) {
    const double radius = random.decade(-3, 3);
    const double distance = radius * (1 + random.decade(-3, 4));
    const Vec3d point = random.direction() * (distance * random.uniform());
    const Vec3d center = point + random.direction() * distance;
    const UnitPair numbers{random.uniform(0, 0.99), i % 9 / 9.0};
    const LightCone cone(point, center, radius);
    const LightConeL wanted(point, center, radius);
    ASSERT_NEAR(static_cast<double>(cone.density() * wanted.solid_angle()), 1, 5e-14) << i;
    const Vec3d direction = cone.direction(numbers);
    const Vec3l about = direction_about_l(normalize(center - point), wanted.angle_of(numbers.u),
                                          2 * pi_l * numbers.v);
    ASSERT_LE(length(vec_cast<long double>(direction) - about), 1e-14L) << i;
    ASSERT_NEAR(cone.free_distance(direction) / static_cast<double>(wanted.distance),
                static_cast<double>(wanted.free_distance(direction) / wanted.distance), 1e-13)
        << i;
  }
}

/// Rays to a sphere must not be blocked by the sphere, as near its edge as they may pass, but by
/// anything a little nearer.
TEST(LightCone, DistancesEndJustBeforeTheSphere) {
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
    Ray ray{point, vec_cast<float>(direction)};
    ray.tmax = static_cast<float>(cone.free_distance(direction));
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
}  // namespace boule::test::light_cone
