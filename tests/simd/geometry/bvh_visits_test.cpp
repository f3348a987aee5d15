#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/simd/geometry/bvh_visits.h"
#include "tests/simd/geometry/bvh_walk.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

/// Balls in the unit cube that cover a picture of it four times over.
std::vector<Sphere> balls(std::size_t count) {
  CaseRandom random(23);
  const auto radius =
      static_cast<float>(std::sqrt(4 / (3.141592653589793 * static_cast<double>(count))));
  std::vector<Sphere> spheres(count);
  for (Sphere& s : spheres) {
    s.center.x = static_cast<float>(random.uniform());
    s.center.y = static_cast<float>(random.uniform());
    s.center.z = static_cast<float>(random.uniform());
    s.radius = radius;
  }
  return spheres;
}

using Ids = std::vector<std::int32_t>;

/// The spheres that are kept apart.
Ids apart(const Bvh& bvh) {
  Ids ids(bvh.slots.begin(), bvh.slots.begin() + bvh.scanned);
  std::erase(ids, empty_slot);
  return ids;
}

TEST(BvhVisits, DomesOnAGroundSphereAreScanned) {
  const std::vector<Sphere> plain = balls(5000);
  std::vector<Sphere> spheres = plain;
  spheres.push_back({{0, 0, 0}, 1e3F, 0});
  spheres.push_back({{0, -1e6F, 0}, 1e6F, 0});
  const Bvh bvh = build_bvh(spheres);
  check(bvh, spheres);
  EXPECT_EQ(apart(bvh), (Ids{5000, 5001}));
  const Bvh alone = build_bvh(plain);
  EXPECT_EQ(bvh.nodes.size(), alone.nodes.size());
  EXPECT_LE(mean_visits(bvh, spheres, 5000, 2).leaves, mean_visits(alone, plain, 5000, 2).leaves);
}

TEST(BvhVisits, SixteenLargestDomesAreScanned) {
  for (const double growth : {1.0, 1.01, 1.5, 2.5}) {
    SCOPED_TRACE(growth);
    std::vector<Sphere> spheres = balls(5000);
    Ids largest;
    for (int i = 0; i < 40; ++i) {
      const bool is_large = growth > 1 ? i >= 40 - 16 : i < 16;
      if (is_large) largest.push_back(static_cast<std::int32_t>(spheres.size()));
      const float x = 0.5F + 0x1p-10F * static_cast<float>(i);  // no copies
      spheres.push_back({{x, 0.5F, 0.5F}, static_cast<float>(20 * std::pow(growth, i)), 0});
    }
    const Bvh bvh = build_bvh(spheres);
    check(bvh, spheres);
    EXPECT_EQ(apart(bvh), largest);
  }
}

TEST(BvhVisits, GiantsAloneGiveNoTree) {
  for (const std::size_t count : {1U, 7U, 16U}) {
    std::vector<Sphere> giants;
    for (std::size_t i = 0; i < count; ++i)
      giants.push_back({{1 + 0x1p-10F * static_cast<float>(i), 2, 3}, 0.5F, 0});
    const Bvh bvh = build_bvh(giants);
    EXPECT_TRUE(bvh.nodes.empty());
    EXPECT_EQ(apart(bvh).size(), count);
  }
}

TEST(BvhVisits, OneGiantAmongMillionsAddsFewVisits) {
  constexpr std::size_t count = 2'000'000;
  std::vector<Sphere> spheres = balls(count);
  const Bvh plain = build_bvh(spheres);
  const Visits expected = mean_visits(plain, spheres, count, 2);
  spheres.emplace_back();
  for (const float radius : {0.2F, 0.3F}) {  // boxes of 16 % and 36 % of all
    SCOPED_TRACE(radius);
    spheres[count] = {{0.5F, 0.5F, 0.5F}, radius, 0};
    const Bvh bvh = build_bvh(spheres);
    const Walk walk = check(bvh, spheres);
    EXPECT_EQ(bvh.scanned, radius > 0.25F ? 16U : 0U);
    EXPECT_LE(walk.depth, 10);
    EXPECT_LT(walk.leaves, count / 7);
    EXPECT_LT(bvh.nodes.size(), walk.leaves / 3);
    const Visits visits = mean_visits(bvh, spheres, count, 2);
    EXPECT_LE(visits.leaves, 1.25 * expected.leaves);
    EXPECT_LE(visits.nodes, 1.25 * expected.nodes);
  }
}

constexpr std::size_t hostile_count = 20'000;

TEST(BvhVisits, SpheresInALineAreNotScanned) {
  std::vector<Sphere> line;
  for (std::size_t i = 0; i < hostile_count; ++i)
    line.push_back({{static_cast<float>(i), 0, 0}, 0.5F, 0});
  const Bvh bvh = build_bvh(line);
  const Walk walk = check(bvh, line);
  EXPECT_EQ(bvh.scanned, 0U);
  const Visits visits = mean_visits(bvh, line, line.size(), 3e4);
  EXPECT_LE(walk.depth, 12);
  EXPECT_LE(visits.leaves, 4);
}

/// Each in all larger ones: boxes cannot tell much. A ray stops at the largest, though, and need
/// not look into boxes behind that.
TEST(BvhVisits, RadiiOverNineDecadesAreNotScanned) {
  std::vector<Sphere> decades;
  for (std::size_t i = 0; i < hostile_count; ++i) {
    const double exponent = 9.0 * static_cast<double>(i) / static_cast<double>(hostile_count);
    decades.push_back({{0, 0, 0}, static_cast<float>(std::pow(10.0, exponent)), 0});
  }
  const Bvh bvh = build_bvh(decades);
  const Walk walk = check(bvh, decades);
  EXPECT_EQ(bvh.scanned, 16U);
  const Visits visits = mean_visits(bvh, decades, decades.size(), 3e9);
  EXPECT_LE(visits.leaves, static_cast<double>(walk.leaves) / 20);
}

/// Each twice as far as the one before: a heuristic peels them off one by one, and the least area
/// is that of a chain of nodes: but of full ones.
TEST(BvhVisits, DoublingDistancesAreNotScanned) {
  std::vector<Sphere> doubling;
  for (std::size_t i = 0; i < hostile_count; ++i) {
    const float far = std::ldexp(1.0F, static_cast<int>(i % 100) - 50);
    doubling.push_back({{far, far, 0}, far * 0.25F, 0});
  }
  const Bvh bvh = build_bvh(doubling);
  const Walk walk = check(bvh, doubling);
  EXPECT_EQ(bvh.scanned, 16U);
  EXPECT_LE(bvh.nodes.size(), walk.leaves / (bvh_width - 4));
}

/// No tree can help here: whoever hits one may hit all, and ids decide. A ray beside them is done
/// at the root.
TEST(BvhVisits, EqualSpheresAreAllVisitedOrNone) {
  const std::vector<Sphere> same(hostile_count, Sphere{{1, 2, 3}, 0.5F, 0});
  const Bvh bvh = build_bvh(same);
  const Walk walk = check(bvh, same);
  EXPECT_EQ(bvh.scanned, 16U);
  EXPECT_LE(walk.depth, 12);
  EXPECT_EQ(mean_visits(bvh, same, same.size(), 2).leaves, static_cast<double>(walk.leaves));
  VisitingRay beside{bvh, same, {1, 3, 0}, {0, 0, 1}};
  beside.run();
  EXPECT_EQ(beside.visits.nodes, 1);
  EXPECT_EQ(beside.visits.leaves, 0);
}

}  // namespace
}  // namespace boule::test
