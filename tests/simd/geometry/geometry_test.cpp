#include "simd/geometry/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/abi/filter_bounds.h"
#include "simd/abi/isa.h"
#include "tests/support/case_random.h"

namespace boule::test::geometry {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Geometry, KeepsOrderValuesAndIds) {
  const std::vector<Sphere> spheres = {{{1, 2, 3}, 4, 0}, {{-5, 6, -7}, 0.5F, 0}};
  const std::vector<Plane> planes = {{{1, 1, 1}, {0, 2, 0}, 0}};
  const Geometry geometry(spheres, planes);
  const GeometryView view = geometry.view();
  ASSERT_EQ(view.spheres.scanned, 2U);
  EXPECT_EQ(view.spheres.block_count, 1U);
  ASSERT_EQ(view.planes.size, 1U);
  EXPECT_EQ(view.planes.first_id, 2);
  EXPECT_EQ(view.spheres.center_x[1], -5);
  EXPECT_EQ(view.spheres.center_y[0], 2);
  EXPECT_EQ(view.spheres.center_z[1], -7);
  EXPECT_EQ(view.spheres.radius[1], 0.5F);
  EXPECT_EQ(view.planes.point_z[0], 1);
  EXPECT_EQ(view.planes.normal_y[0], 2);
}

TEST(Geometry, PaddingIsNeverHit) {
  const Geometry geometry({{{1, 2, 3}, 4, 0}}, {{{1, 1, 1}, {0, 2, 0}, 0}});
  const GeometryView view = geometry.view();
  for (std::size_t i = 1; i < max_width; ++i) {
    EXPECT_TRUE(std::isnan(view.spheres.radius[i]));
    EXPECT_EQ(view.spheres.reject_squared[i], -inf);
    EXPECT_EQ(view.planes.normal_x[i], 0);
    EXPECT_EQ(view.planes.normal_y[i], 0);
    EXPECT_EQ(view.planes.normal_z[i], 0);
  }
}

TEST(Geometry, BlocksHoldExactlyTheSpheresListed) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 155; ++i) {
    const auto x = static_cast<float>(i);
    spheres.push_back({{x, 2 * x, -x}, 0.5F + x, 0});
  }
  const Geometry geometry(spheres, {}, Structure::bvh);
  const SphereView view = geometry.view().spheres;
  ASSERT_GT(view.block_count, 5U);
  std::vector<int> found;
  for (std::size_t i = 0; i < view.block_count * bvh_leaf_size; ++i) {
    const SphereBlock& block = view.blocks[i / bvh_leaf_size];
    const std::size_t k = i % bvh_leaf_size;
    const std::int32_t id = view.id[i];
    if (id < 0) {
      EXPECT_TRUE(std::isnan(block.radius[k]));
      continue;
    }
    found.push_back(id);
    const Sphere& sphere = spheres[static_cast<std::size_t>(id)];
    EXPECT_EQ((Vec3f{block.center_x[k], block.center_y[k], block.center_z[k]}), sphere.center);
    EXPECT_EQ(block.radius[k], sphere.radius);
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), spheres.size());
  for (int i = 0; i < 155; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i)], i);
}

TEST(Geometry, RejectNumbersAreRoundedOutward) {
  CaseRandom random(1);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 5000; ++i) {
    const double exponent = random.uniform(-149, 59);
    spheres.push_back({{0, 0, 0}, static_cast<float>(std::exp2(exponent)), 0});
  }
  const Geometry geometry(spheres, {}, Structure::scan);
  const SphereView view = geometry.view().spheres;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double r = spheres[i].radius;
    const double r2p = r * r * (1 + 24 * 0x1p-24) + 1e-36, rp = r * (1 + 24 * 0x1p-24) + 1e-18;
    ASSERT_GE(double{view.reject_squared[i]}, r2p);
    ASSERT_LE(double{view.reject_squared[i]}, r2p * (1 + 2 * 0x1p-23));
    ASSERT_GE(double{view.reject_radius[i]}, rp);
    ASSERT_LE(double{view.reject_radius[i]}, rp * (1 + 2 * 0x1p-23));
  }
}

TEST(Geometry, TheFilterDecidesNothingBeyondItsRange) {
  const std::vector<Sphere> spheres = {
      {{1e18F, 0, 0}, 1, 0}, {{0, -2e18F, 0}, 1, 0}, {{0, 0, 0}, 1e18F, 0}, {{nan, 0, 0}, 1, 0},
      {{0, inf, 0}, 1, 0},   {{0, 0, 0}, nan, 0},    {{0, 0, -inf}, 1, 0},  {{0, 0, 0}, inf, 0}};
  const Geometry geometry(spheres, {}, Structure::scan);
  const SphereView view = geometry.view().spheres;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    EXPECT_EQ(view.reject_squared[i], inf) << i;
    EXPECT_EQ(view.reject_radius[i], inf) << i;
  }
}

TEST(Geometry, BuildsATreeOverFortyNineSpheres) {
  const std::vector<Sphere> spheres(49, Sphere{{1, 2, 3}, 1, 0});
  EXPECT_EQ(Geometry({spheres.begin(), spheres.begin() + 48}, {}).view().bvh.size, 0U);
  EXPECT_GT(Geometry(spheres, {}).view().bvh.size, 0U);
}

/// Without a tree too the extent bounds every coordinate of a sphere; NaN has none.
TEST(Geometry, ExtentIncludesScannedSpheres) {
  const auto extent = [](const std::vector<Sphere>& spheres) {
    return Geometry(spheres, {}, Structure::scan).view().bvh.extent;
  };
  EXPECT_EQ(extent({}), 0);
  EXPECT_EQ(extent({{{1, -7, 2}, -3, 0}, {{nan, 50, 0}, 1, 0}, {{0, 0, 0}, nan, 0}}), 51);
  EXPECT_EQ(extent({{{1, 0x1p-30F, 0}, 1e-9F, 0}}), std::nextafter(1.0F, 2.0F));
  EXPECT_EQ(extent({{{0, 0, 3e38F}, 2e38F, 0}}), inf);
  EXPECT_EQ(extent({{{0, 0, 0}, inf, 0}}), inf);
}

}  // namespace
}  // namespace boule::test::geometry
