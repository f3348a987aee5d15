// Surfaces at double against long double by other formulas. That every kernel table has the same
// bits: tests/equivalence/surface_kernels_test.cpp.
#include "core/optics/incidence.h"

#include <gtest/gtest.h>

#include "core/reference.h"
#include "core/surface.h"
#include "tests/support/case_random.h"
#include "tests/support/long_double_formulas.h"

namespace boule::test {
namespace {

constexpr int many = 200000;

void expect_near(const Vec3d& a, const Vec3l& b, long double error) {
  EXPECT_LE(length(vec_cast<long double>(a) - b), error);
}

/// Of a surface that was met on this side, with this normal and reach.
void expect_surface(const Surface& surface, const Ray& ray, const Vec3l& outward, bool inner,
                    long double reach) {
  const IncidenceL at(ray.dir, outward, inner);
  EXPECT_EQ(surface.inner, inner);
  expect_near(surface.normal, at.normal, 1e-15L);
  expect_near(surface.view, at.view, 1e-15L);
  expect_near(surface.mirrored, at.mirrored, 4e-15L);
  EXPECT_NEAR(surface.cosine, static_cast<double>(at.cosine), 1e-15);
  EXPECT_NEAR(surface.reach / static_cast<double>(reach), 1, 1e-15);
  for (const Side side : {Side::viewer, Side::beyond}) {
    const Vec3l step = departure_step(at.normal, side == Side::viewer ? reach : -reach);
    const Vec3l point = vec_cast<long double>(surface.point);
    const Vec3l moved = vec_cast<long double>(depart(surface, side).org) - point;
    const Vec3l off = moved - step;
    const auto rounding = [](long double x) { return std::fabs(x) * 0x1p-53L + 1e-30L; };
    EXPECT_LE(std::fabs(off.x), rounding(point.x + step.x) + 1e-14L * std::fabs(step.x));
    EXPECT_LE(std::fabs(off.y), rounding(point.y + step.y) + 1e-14L * std::fabs(step.y));
    EXPECT_LE(std::fabs(off.z), rounding(point.z + step.z) + 1e-14L * std::fabs(step.z));
  }
}

TEST(Incidence, OnSpheresEqualsLongDouble) {
  CaseRandom random(41);
  int inside = 0, outside = 0;
  for (int i = 0; i < many && !HasFailure(); ++i) {
    const auto radius = static_cast<float>(random.decade(-3, 3));
    const Vec3f center = vec_cast<float>(random.direction() * random.decade(-3, 3));
    const Vec3d c = vec_cast<double>(center);
    const double away = i % 3 == 0 ? random.uniform(0, 0.99) : 1 + random.decade(-2, 3);
    Ray ray{c + random.direction() * (double{radius} * away), {}};
    const Vec3d target = c + random.direction() * (double{radius} * random.uniform(0, 0.99));
    ray.dir = vec_cast<float>(target - ray.org);
    const Sphere sphere{center, radius, 0};
    const double t = reference::intersect(ray, sphere, false);
    if (!std::isfinite(t)) continue;
    const Surface surface = find_surface(sphere, ray, {t, 0});
    SCOPED_TRACE(i);
    expect_near(surface.point,
                vec_cast<long double>(ray.org) +
                    vec_cast<long double>(ray.dir) * static_cast<long double>(t),
                0x1p-51L * length(surface.point) + 0x1p-51L * length(ray.org));
    const Vec3l l = vec_cast<long double>(center);
    const bool starts_inside = away < 1;
    ++(starts_inside ? inside : outside);
    expect_surface(surface, ray, unit(vec_cast<long double>(surface.point) - l), starts_inside,
                   length(l - vec_cast<long double>(ray.org)) + radius);
  }
  EXPECT_GT(inside, many / 4);
  EXPECT_GT(outside, many / 3);
}

TEST(Incidence, OnPlanesEqualsLongDouble) {
  CaseRandom random(42);
  int met = 0;
  for (int i = 0; i < many && !HasFailure(); ++i) {
    const Vec3f point = vec_cast<float>(random.direction() * random.decade(-3, 3));
    const Vec3f normal = vec_cast<float>(random.direction() * random.decade(-3, 3));
    const Ray ray{random.direction() * random.decade(-3, 3), vec_cast<float>(random.direction())};
    const Plane plane{point, normal, 0};
    const double t = reference::intersect(ray, plane, false);
    if (!std::isfinite(t)) continue;
    ++met;
    SCOPED_TRACE(i);
    const Surface surface = find_surface(plane, ray, {t, 0});
    const Vec3l n = vec_cast<long double>(normal), org = vec_cast<long double>(ray.org);
    expect_surface(surface, ray, unit(n), dot(n, vec_cast<long double>(ray.dir)) > 0,
                   length(vec_cast<long double>(point) - org) +
                       length(vec_cast<long double>(surface.point) - org));
  }
  EXPECT_GT(met, many / 4);
}

/// A ray whose interval begins behind its origin may meet the near side from an origin inside.
TEST(Incidence, AngleDecidesTheSideBehindTheOrigin) {
  const Sphere sphere{{0, 0, 0}, 2, 0};
  Ray ray{{0, 0, 1}, {0, 0, -1}};
  ray.tmin = -10;
  EXPECT_FALSE(find_surface(sphere, ray, {-1, 0}).inner);
  EXPECT_TRUE(find_surface(sphere, ray, {3, 0}).inner);
}

}  // namespace
}  // namespace boule::test
