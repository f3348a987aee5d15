#include "core/scene/axis_extremes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace boule::test::axis_extremes {
namespace {

bool has(const std::vector<Sphere>& spheres, const Sphere& one) {
  for (const Sphere& sphere : spheres) {
    if (sphere.center == one.center && sphere.radius == one.radius) return true;
  }
  return false;
}

/// Along x the outermost surface is not that of the outermost centre.
const std::vector<Sphere> spheres{{{5, 0, 0}, 1, 0},  {{4.5F, 0, 0}, 2, 0}, {{-5, 0, 0}, 1, 0},
                                  {{0, 6, 0}, 1, 0},  {{0, -6, 0}, 1, 0},   {{0, 0, 7}, 1, 0},
                                  {{0, 0, -7}, 1, 0}, {{0, 0, 0}, 3, 0},    {{1, 1, 1}, 0.5F, 0}};

TEST(AxisExtremes, HoldOutermostSpheresAndTheLargestRadius) {
  AxisExtremes extremes;
  EXPECT_TRUE(extremes.spheres().empty());
  for (const Sphere& sphere : spheres) extremes.add(sphere);
  const std::vector<Sphere> found = extremes.spheres();
  EXPECT_EQ(found.size(), 13U);
  for (std::size_t i = 0; i + 1 < spheres.size(); ++i) EXPECT_TRUE(has(found, spheres[i])) << i;
  EXPECT_FALSE(has(found, spheres.back()));
}

/// A lattice, in which many spheres lie outermost.
std::vector<Sphere> lattice() {
  std::vector<Sphere> all;
  for (std::uint32_t i = 0; i < 125; ++i) {
    const Vec3f center{static_cast<float>(i % 5), static_cast<float>(i / 5 % 5),
                       static_cast<float>(i / 25)};
    all.push_back({center, i % 3 == 0 ? 0.5F : 0.25F, i});
  }
  return all;
}

TEST(AxisExtremes, TiesKeepTheFirstInAnyPartition) {
  const std::vector<Sphere> all = lattice();
  const auto materials_of = [](const AxisExtremes& extremes) {
    std::vector<std::uint32_t> materials;
    for (const Sphere& sphere : extremes.spheres()) materials.push_back(sphere.material.index());
    return materials;
  };
  AxisExtremes whole;
  for (const Sphere& sphere : all) whole.add(sphere);
  EXPECT_EQ(materials_of(whole),
            (std::vector<std::uint32_t>{0, 0, 4, 0, 9, 0, 20, 0, 21, 0, 100, 0, 102}));
  for (std::size_t cut = 0; cut <= all.size(); ++cut) {
    AxisExtremes first, later;
    for (std::size_t i = 0; i < all.size(); ++i) (i < cut ? first : later).add(all[i]);
    first.add(later);
    EXPECT_EQ(materials_of(first), materials_of(whole)) << cut;
  }
}

}  // namespace
}  // namespace boule::test::axis_extremes
