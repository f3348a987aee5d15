// Pairs of spheres, judged by every pair by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "render/renderer/tracer.h"
#include "simd/points/point_distance.h"
#include "tests/support/case_random.h"

namespace boule::test::tracer_pairs {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr int spheres_of_case = 300;

struct Pair {
  std::int32_t first, second;
  double gap;

  bool operator==(const Pair&) const = default;
};

/// Every pair by exact decisions, which other tests judge.
std::vector<Pair> all_pairs(const std::vector<Sphere>& spheres, double limit) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      const Ball both{spheres[j].center, spheres[j].radius, spheres[i].radius};
      const Vec3d point = vec_cast<double>(spheres[i].center);
      if (!is_within(both, point, limit)) continue;
      pairs.push_back(
          {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), find_distance(both, point)});
    }
  }
  return pairs;
}

std::vector<Pair> found_pairs(const std::vector<Sphere>& spheres, double limit) {
  Scene scene;
  scene.materials = {{"", Matte{}}};
  scene.spheres = spheres;
  auto tracer = Tracer::create(std::move(scene), {});
  const SpherePairs found = tracer.value().pairs(limit).value();
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < found.gap.size(); ++k)
    pairs.push_back({found.first[k], found.second[k], found.gap[k]});
  return pairs;
}

/// Spheres in a cube, whose radii are up to `decades` apart.
std::vector<Sphere> spheres_in(CaseRandom& random, double size, double decades) {
  const double radius = size / std::cbrt(double{spheres_of_case});
  std::vector<Sphere> spheres;
  for (int i = 0; i < spheres_of_case; ++i) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size);
    const double z = random.uniform(-size, size), r = radius * random.decade(-decades, 0);
    spheres.push_back({{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)},
                       std::max(static_cast<float>(r), std::numeric_limits<float>::denorm_min())});
  }
  return spheres;
}

/// From sizes whose squares a float has not to those whose squares are beyond it.
TEST(TracerPairs, AreExactAtAllScales) {
  CaseRandom random(91);
  for (const double size : {1e-42, 1e-37, 1e-30, 1e-18, 1e-3, 1.0, 1e6, 1e18, 1e20, 1e30, 1e37}) {
    for (const double decades : {0.0, 3.0}) {
      const auto spheres = spheres_in(random, size, decades);
      for (const double share : {-inf, -1.0, -0.2, -1e-3, 0.0, 1e-3, 0.1, 10.0, 1e20, inf}) {
        const double gap = share * size;
        ASSERT_EQ(found_pairs(spheres, gap), all_pairs(spheres, gap)) << size << " " << gap;
      }
    }
  }
}

/// The limit is the very gap of a pair, where float can tell nothing; squares of 1e-22 are among
/// the last that a float has.
TEST(TracerPairs, LimitsCountTheirEnd) {
  CaseRandom random(92);
  for (const auto& [size, decades] : {std::pair{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {1e-22, 0.0}}) {
    const auto spheres = spheres_in(random, size, decades);
    const auto all = all_pairs(spheres, inf);
    for (int k = 0; k < 60; ++k) {
      const Pair& one = all[static_cast<std::size_t>(random.below(1 << 20)) % all.size()];
      for (const double gap : {one.gap, std::nextafter(one.gap, -inf)})
        ASSERT_EQ(found_pairs(spheres, gap), all_pairs(spheres, gap)) << size << " " << gap;
    }
  }
}

}  // namespace
}  // namespace boule::test::tracer_pairs
