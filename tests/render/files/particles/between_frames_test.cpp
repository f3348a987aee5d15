// Frames between two: binary fractions, so that all answers are exact.
#include "render/files/particles/between_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::row_of;
using test::row_of_particles;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ParticleFrame at(const std::vector<Vec3d>& positions) {
  ParticleFrame frame;
  frame.positions = positions;
  return frame;
}

/// In a cell of side 16 that is periodic along a and b.
ParticleFrame in_cell(const std::vector<Vec3d>& positions, const Vec3d& size = {16, 16, 16}) {
  ParticleFrame frame = at(positions);
  frame.cell =
      ParticleCell{{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}, {}, {true, true, false}};
  return frame;
}

std::vector<Vec3d> positions_of(const ParticleFrame& a, const ParticleFrame& b, double share) {
  const auto between = between_frames(a, b, share);
  EXPECT_TRUE(between) << between.error().message;
  return between ? between.value().positions : std::vector<Vec3d>{};
}

using Positions = std::vector<Vec3d>;

TEST(BetweenFrames, PositionsMoveStraight) {
  const ParticleFrame a = at({{0, 0, 0}, {8, 4, -2}}), b = at({{4, 8, 16}, {8, 0, 2}});
  EXPECT_EQ(positions_of(a, b, 0.25), (Positions{{1, 2, 4}, {8, 3, -1}}));
  EXPECT_EQ(positions_of(a, b, 0.75), (Positions{{3, 6, 12}, {8, 1, 1}}));
}

TEST(BetweenFrames, PeriodicFacesAreCrossed) {
  const ParticleFrame a = in_cell({{15, 1, 15}}), b = in_cell({{3, 13, 3}});
  // Along x 4 upward through the face, along y 4 downward; along z there is no face to cross.
  EXPECT_EQ(positions_of(a, b, 0.125), (Positions{{15.5, 0.5, 13.5}}));
  EXPECT_EQ(positions_of(a, b, 0.5), (Positions{{1, 15, 9}}));
  EXPECT_EQ(positions_of(a, b, 0.75), (Positions{{2, 14, 6}}));
}

TEST(BetweenFrames, OutsideTheCellImagesChangeHalfway) {
  // A whole molecule that sticks out of the cell is put back on the other side at once.
  const ParticleFrame a = in_cell({{15, 8, 8}, {17, 8, 8}}), b = in_cell({{0, 8, 8}, {2, 8, 8}});
  EXPECT_EQ(positions_of(a, b, 0.25)[1], (Vec3d{17.25, 8, 8}));
  EXPECT_EQ(positions_of(a, b, 0.75)[1], (Vec3d{1.75, 8, 8}));
}

TEST(BetweenFrames, CellsMoveToo) {
  ParticleFrame a = in_cell({{15, 8, 8}}), b = in_cell({{1, 8, 8}}, {32, 16, 16});
  b.cell->origin = {-4, 0, 0};
  a.time = 2, b.time = 6;
  const auto between = between_frames(a, b, 0.5);
  ASSERT_TRUE(between) << between.error().message;
  EXPECT_EQ(between.value().cell->a, (Vec3d{24, 0, 0}));
  EXPECT_EQ(between.value().cell->origin, (Vec3d{-2, 0, 0}));
  EXPECT_EQ(between.value().time, 4);
  // 15 of 16 cells are 0.9375, 5 of 32 are 0.15625: upward to 33, then one vector of 24 back.
  EXPECT_EQ(between.value().positions, (Positions{{24.0 - 24, 8, 8}}));
}

TEST(BetweenFrames, IdsSayWhoIsWho) {
  ParticleFrame a = at({{0, 0, 0}, {8, 0, 0}, {16, 0, 0}}),
                b = at({{20, 0, 0}, {0, 4, 0}, {8, 8, 0}});
  a.numbers = {{"id", {7, 3, 5}}, {"q", {1.5, 2, nan}}};
  b.numbers = {{"q", {3, 2.5, 1}}, {"id", {5, 7, 3}}};
  const auto between = between_frames(a, b, 0.5);
  ASSERT_TRUE(between) << between.error().message;
  EXPECT_EQ(between.value().positions, (Positions{{0, 2, 0}, {8, 4, 0}, {18, 0, 0}}));
  EXPECT_EQ(between.value().numbers[0].values, (std::vector<double>{7, 3, 5}));
  EXPECT_EQ(between.value().numbers[1].values[0], 2);
  EXPECT_EQ(between.value().numbers[1].values[1], 1.5);
  EXPECT_TRUE(std::isnan(between.value().numbers[1].values[2]));
}

TEST(BetweenFrames, KindsStay) {
  ParticleFrame a = row_of({"C", "O"}), b = row_of({"O", "C"});
  a.numbers = {{"cluster", {1, 2}}};
  b.numbers = {{"cluster", {2, 5}}};
  const auto between = between_frames(a, b, 0.75);
  ASSERT_TRUE(between);
  EXPECT_EQ(between.value().numbers[0].values, (std::vector<double>{1, 2}));
  EXPECT_EQ(between.value().species->texts, (std::vector<std::string>{"C", "O"}));
}

TEST(BetweenFrames, OtherParticlesAreRefused) {
  const auto refused = [](const ParticleFrame& a, const ParticleFrame& b) {
    const auto between = between_frames(a, b, 0.5);
    EXPECT_FALSE(between);
    return between ? "" : between.error().message;
  };
  EXPECT_THAT(refused(row_of_particles(2), row_of_particles(3)),
              HasSubstr("a frame has 2 particles, the next one 3"));
  ParticleFrame a = row_of_particles(2), b = row_of_particles(2);
  a.numbers = {{"id", {1, 2}}};
  b.numbers = {{"id", {1, 3}}};
  EXPECT_THAT(refused(a, b), HasSubstr("the next frame has no id 2"));
  b.numbers = {{"id", {1, 1}}};
  EXPECT_THAT(refused(a, b), HasSubstr("the id 1 twice"));
}

}  // namespace
}  // namespace boule
