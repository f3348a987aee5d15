#include "core/scene/axis_extremes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace boule::test {
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

TEST(AxisExtremes, HaveTheOutermostCentersAndSurfacesAndTheLargestRadius) {
  AxisExtremes extremes;
  EXPECT_TRUE(extremes.spheres().empty());
  for (const Sphere& sphere : spheres) extremes.add(sphere);
  const std::vector<Sphere> found = extremes.spheres();
  EXPECT_EQ(found.size(), 13U);
  for (std::size_t i = 0; i + 1 < spheres.size(); ++i) EXPECT_TRUE(has(found, spheres[i])) << i;
  EXPECT_FALSE(has(found, spheres.back()));
}

TEST(AxisExtremes, KeepTheFirstOfSeveralHoweverTheSpheresAreCut) {
  std::vector<Sphere> twice = spheres;
  for (Sphere sphere : spheres) {
    sphere.material = 1;
    twice.push_back(sphere);
  }
  for (std::size_t cut = 0; cut <= twice.size(); ++cut) {
    AxisExtremes first, later;
    for (std::size_t i = 0; i < twice.size(); ++i) (i < cut ? first : later).add(twice[i]);
    first.add(later);
    for (const Sphere& sphere : first.spheres()) EXPECT_EQ(sphere.material.index(), 0U) << cut;
  }
}

}  // namespace
}  // namespace boule::test
