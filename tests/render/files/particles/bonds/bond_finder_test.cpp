#include "render/files/particles/bonds/bond_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/math/geometry.h"
#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::threaded_for;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t any_number = 1U << 30;

BondSearch nearer_than(double distance) {
  BondSearch search;
  search.reach.values = {distance / 2};
  return search;
}

std::vector<Bond> bonds_of(const std::vector<Vec3d>& positions, const BondSearch& search,
                           const std::optional<ParticleCell>& cell = {}) {
  return find_bonds(positions, cell, search, any_number, serial_for).value();
}

ParticleCell cube(double side) {
  return {.a = {side, 0, 0}, .b = {0, side, 0}, .c = {0, 0, side}, .periodic = {true, true, true}};
}

std::vector<Vec3d> random_points(std::size_t count, double side) {
  std::mt19937 random(7);
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&] { return side * static_cast<double>(random()) * 0x1p-32; };
    points.push_back({number(), number(), number()});
  }
  return points;
}

/// Every pair, and images up to `images` cells away.
std::vector<Bond> all_pairs(const std::vector<Vec3d>& points, const ParticleCell& cell,
                            double distance, std::int32_t images) {
  std::vector<Bond> bonds;
  for (std::uint32_t a = 0; a < points.size(); ++a) {
    for (std::uint32_t b = a; b < points.size(); ++b) {
      for (std::int32_t x = -images; x <= images; ++x) {
        for (std::int32_t y = -images; y <= images; ++y) {
          for (std::int32_t z = -images; z <= images; ++z) {
            const std::array<std::int32_t, 3> image{x, y, z};
            if (a == b && !(image > std::array<std::int32_t, 3>{})) continue;
            const Vec3d way = points[b] + cell.a * double(x) + cell.b * double(y) +
                              cell.c * double(z) - points[a];
            if (dot(way, way) < distance * distance) bonds.push_back({a, b, image});
          }
        }
      }
    }
  }
  return bonds;
}

TEST(BondFinder, DistanceIsBelowTheLimit) {
  const std::vector<Vec3d> row{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_THAT(bonds_of(row, nearer_than(1)), IsEmpty());
  EXPECT_THAT(bonds_of(row, nearer_than(1.001)), ElementsAre(Bond{0, 1, {}}));
  EXPECT_THAT(bonds_of(row, nearer_than(2.001)), ElementsAre(Bond{0, 1, {}}, Bond{1, 2, {}}));
}

TEST(BondFinder, OnePlaceIsNoBond) {
  EXPECT_THAT(bonds_of({{1, 2, 3}, {1, 2, 3}}, nearer_than(1)), IsEmpty());
}

TEST(BondFinder, ReachesAddUp) {
  BondSearch search;
  search.reach.values = {0.3, 0.8, 0};
  search.tolerance = 0.1;
  EXPECT_THAT(bonds_of({{0, 0, 0}, {1.19, 0, 0}, {0.5, 0, 0}}, search),
              ElementsAre(Bond{0, 1, {}}));
  EXPECT_THAT(bonds_of({{0, 0, 0}, {1.21, 0, 0}, {0.5, 0, 0}}, search), IsEmpty());
  search.nearest = 1.195;
  EXPECT_THAT(bonds_of({{0, 0, 0}, {1.19, 0, 0}, {0.5, 0, 0}}, search), IsEmpty());
}

TEST(BondFinder, AgreesWithAllPairs) {
  const auto points = random_points(400, 10);
  const auto found = bonds_of(points, nearer_than(1.7));
  EXPECT_GT(found.size(), 500U);
  EXPECT_EQ(found, all_pairs(points, cube(0), 1.7, 0));
}

TEST(BondFinder, TiltedCellsAgreeWithAllPairs) {
  const ParticleCell cell{.a = {6, 0, 0},
                          .b = {2.5, 5, 0},
                          .c = {-1, 2, 7},
                          .origin = {3, 1, 2},
                          .periodic = {true, true, true}};
  const auto points = random_points(60, 20);  // many outside of the cell
  auto found = bonds_of(points, nearer_than(2), cell);
  auto expected = all_pairs(points, cell, 2, 7);
  EXPECT_GT(found.size(), 100U);
  EXPECT_EQ(found, expected);
}

TEST(BondFinder, SmallCellsHaveManyImages) {
  const auto found = bonds_of({{0.2, 0.3, 0.4}}, nearer_than(2.1), cube(1));
  EXPECT_EQ(found, all_pairs({{0.2, 0.3, 0.4}}, cube(1), 2.1, 3));
  EXPECT_EQ(found.size(), 16U);  // half of 6 + 12 + 8 + 6
}

TEST(BondFinder, OnlyPeriodicEdgesAreCrossed) {
  ParticleCell cell = cube(10);
  cell.periodic = {false, true, false};
  const std::vector<Vec3d> points{{0.2, 5, 5}, {9.8, 5, 5}, {5, 0.2, 5}, {5, 9.8, 5}};
  EXPECT_THAT(bonds_of(points, nearer_than(1), cell), ElementsAre(Bond{2, 3, {0, -1, 0}}));
}

TEST(BondFinder, FlatCellsAreLeftAside) {
  ParticleCell cell = cube(10);
  cell.c = cell.a;
  EXPECT_THAT(bonds_of({{0, 0, 0}, {0.5, 0, 0}}, nearer_than(1), cell),
              ElementsAre(Bond{0, 1, {}}));
}

TEST(BondFinder, FarPointsCostNothing) {
  auto points = random_points(20000, 20);
  const auto near = bonds_of(points, nearer_than(0.5));
  points.push_back({1e30, -1e30, 1e300});
  points.push_back({-1e15, 3, 4});
  EXPECT_EQ(bonds_of(points, nearer_than(0.5)), near);
  EXPECT_THAT(bonds_of({{1e12, 0, 0}, {1e12 + 0.25, 0, 0}}, nearer_than(1), cube(3)),
              ElementsAre(Bond{0, 1, {}}));
}

TEST(BondFinder, ThreadsChangeNothing) {
  const auto points = random_points(150000, 60);
  const auto one = bonds_of(points, nearer_than(1), cube(60));
  EXPECT_EQ(find_bonds(points, cube(60), nearer_than(1), any_number, threaded_for(3)).value(), one);
}

TEST(BondFinder, HydrogensKeepTheNearest) {
  BondSearch search = nearer_than(1.6);
  search.single = {0, 1, 0, 1, 1};
  // The second hydrogen is nearer to the first than to anything else.
  const std::vector<Vec3d> row{{0, 0, 0}, {1, 0, 0}, {2.1, 0, 0}, {1, 0.5, 0}, {1, 1.1, 0}};
  EXPECT_THAT(bonds_of(row, search), ElementsAre(Bond{0, 1, {}}, Bond{0, 3, {}}, Bond{0, 4, {}}));
  search.single = {1, 1};
  EXPECT_THAT(bonds_of({{0, 0, 0}, {0.7, 0, 0}}, search), ElementsAre(Bond{0, 1, {}}));
}

TEST(BondFinder, KnownOnesAreNotBonded) {
  BondSearch search = nearer_than(1.1);
  search.known = {1, 1, 0};
  EXPECT_THAT(bonds_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, search), ElementsAre(Bond{1, 2, {}}));
}

TEST(BondFinder, TooManyAreRefused) {
  const auto points = random_points(1000, 1);
  const auto found = find_bonds(points, {}, nearer_than(5), 1000, serial_for);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().key, "bonds");
  EXPECT_THAT(found.error().message, HasSubstr("more than 1000 bonds"));
  const auto images = find_bonds(points, cube(1e-6), nearer_than(5), any_number, serial_for);
  ASSERT_FALSE(images.ok());
  EXPECT_THAT(images.error().message, HasSubstr("looking for bonds needs"));
}

TEST(NearestImages, BondsOfFilesCrossFaces) {
  const std::vector<Vec3d> points{{0.5, 5, 5}, {9.5, 5, 5}, {12, 9.9, 5}, {4, 0.1, 5}};
  EXPECT_THAT(nearest_images({{0, 1}, {2, 3}}, points, cube(10)),
              ElementsAre(Bond{0, 1, {-1, 0, 0}}, Bond{2, 3, {1, 1, 0}}));
  EXPECT_THAT(nearest_images({{0, 1}}, points, {}), ElementsAre(Bond{0, 1, {}}));
  // As near through the face as inside: the file's own image.
  EXPECT_THAT(nearest_images({{0, 1}}, {{0, 0, 0}, {5, 0, 0}}, cube(10)),
              ElementsAre(Bond{0, 1, {}}));
}

}  // namespace
}  // namespace boule
