#include "render/files/particles/bonds/whole_molecules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/files/particles/cell_fractions.h"
#include "tests/render/files/particles/particle_frames.h"

// Molecules across faces of the cell are made whole.

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of_particles;
using test::text_column;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::array<bool, 3> each_way{true, true, true};
const ParticleCell cell_of_ten{{10, 0, 0}, {0, 10, 0}, {0, 0, 10}, {}, each_way};
const ParticleCell leaning{{10, 0, 0}, {3, 9, 0}, {-2, 4, 8}, {1, 2, 3}, each_way};

/// A chain of particles 1 apart that winds through space, each wrapped into the cell.
ParticleFrame wrapped_chain(const ParticleCell& cell, std::size_t count, const Vec3d& start) {
  ParticleFrame frame;
  Vec3d at = start;
  for (std::size_t i = 0; i < count; ++i) {
    frame.positions.push_back(at);
    if (i > 0) frame.bonds.push_back({static_cast<std::uint32_t>(i - 1), std::uint32_t(i)});
    const auto turn = static_cast<double>(i) * 0.1;
    at = at + Vec3d{std::cos(turn) * 0.6, std::sin(turn) * 0.6, 0.8};
  }
  frame.lists_all_bonds = true;
  frame.cell = cell;
  EXPECT_TRUE(wrap_into(cell, frame.positions, serial_for));
  return frame;
}

std::vector<Vec3d> centers_of(const ParticleFrame& frame, ParticleStyle style) {
  style.radius = 0.5;
  style.unwrap = true;
  std::vector<Vec3d> centers;
  for (const Sphere& sphere : test::spheres_of(frame, style))
    centers.push_back(vec_cast<double>(sphere.center));
  return centers;
}

double distance_of(const Vec3d& a, const Vec3d& b) { return std::sqrt(dot(a - b, a - b)); }

TEST(Unwrap, ChainsAreWholeInAnyCell) {
  for (const ParticleCell& cell : {cell_of_ten, leaning}) {
    const ParticleFrame frame = wrapped_chain(cell, 200, {2, 3, 4});
    const auto centers = centers_of(frame, {});
    ASSERT_EQ(centers.size(), 200U);
    EXPECT_NEAR(distance_of(centers[0], frame.positions[0]), 0, 1e-6);
    for (std::size_t i = 1; i < centers.size(); ++i)
      EXPECT_NEAR(distance_of(centers[i - 1], centers[i]), 1, 1e-4);
    EXPECT_GT(distance_of(centers[0], centers[199]), 100);
  }
}

TEST(Unwrap, MiddlesAreWrappedIntoTheCell) {
  const ParticleFrame frame = wrapped_chain(leaning, 50, {2, 3, 4});
  const auto centers = centers_of(frame, {.wrap = true});
  ASSERT_EQ(centers.size(), 50U);
  Vec3d mean{};
  for (const Vec3d& center : centers) mean = mean + center * (1.0 / 50);
  const auto fractions = CellFractions::of(leaning);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(fractions->fraction(k, mean), 0);
    EXPECT_LT(fractions->fraction(k, mean), 1);
  }
  EXPECT_NEAR(distance_of(centers[0], centers[1]), 1, 1e-5);
}

TEST(Unwrap, BondsOfWholeMoleculesAreWhole) {
  const ParticleFrame frame = wrapped_chain(cell_of_ten, 30, {9, 9, 9});
  const auto made =
      ParticleSpheres::make(frame, {.radius = 0.5, .bonds = BondRule::file, .unwrap = true});
  std::vector<Capsule> capsules;
  ASSERT_TRUE(made.ok() && made.value().append_capsules_to(capsules, {}).ok());
  EXPECT_EQ(capsules.size(), 29U);
}

TEST(Unwrap, EndlessMoleculesStayAsTheyAre) {
  // A chain along x through the cell, and a pair across its face.
  std::vector<Vec3d> positions{{1, 5, 5}, {4, 5, 5}, {7, 5, 5}, {9.5, 1, 1}, {0.5, 1, 1}};
  const std::vector<Vec3d> before = positions;
  std::vector<Bond> bonds{{0, 1, {}}, {0, 2, {-1, 0, 0}}, {1, 2, {}}, {3, 4, {1, 0, 0}}};
  const auto endless = join_molecules(cell_of_ten, true, positions, bonds);
  ASSERT_TRUE(endless.ok());
  EXPECT_EQ(endless.value(), 1U);
  EXPECT_THAT(positions,
              ElementsAre(before[0], before[1], before[2], Vec3d{-0.5, 1, 1}, Vec3d{0.5, 1, 1}));
  EXPECT_EQ(bonds[1].image, (std::array<std::int32_t, 3>{-1, 0, 0}));
  EXPECT_EQ(bonds[3].image, (std::array<std::int32_t, 3>{}));
}

TEST(Unwrap, ItsOwnImageMakesAParticleEndless) {
  ParticleFrame frame = row_of_particles(1);
  frame.cell = ParticleCell{{1, 0, 0}, {0, 9, 0}, {0, 0, 9}, {}, each_way};
  EXPECT_THAT(notes_of(frame, {.radius = 0.2, .bonds = 1.1, .unwrap = true}),
              HasSubstr("one molecule goes through the cell without end"));
}

TEST(Unwrap, BondsByDistanceServeToo) {
  ParticleFrame frame = row_of_particles(3);
  frame.positions = {{0.1, 5, 5}, {9.3, 5.5, 5}, {9.6, 4.2, 5}};
  frame.species = text_column("element", {"O", "H", "H"});
  frame.cell = cell_of_ten;
  const auto centers = centers_of(frame, {});
  ASSERT_EQ(centers.size(), 3U);
  EXPECT_NEAR(centers[1].x, -0.7, 1e-6);
  EXPECT_NEAR(centers[2].x, -0.4, 1e-6);
  EXPECT_THAT(notes_of(frame, {.unwrap = true}), Not(HasSubstr("without end")));
}

TEST(Unwrap, RefusesWhatCannotBeUnwrapped) {
  ParticleFrame frame = row_of_particles(2);
  EXPECT_EQ(error_of(frame, {.unwrap = true}), "unwrap: the file tells no cell");
  frame.cell = cell_of_ten;
  EXPECT_THAT(error_of(frame, {.unwrap = true}),
              HasSubstr("unwrap: the file tells neither bonds nor elements"));
  EXPECT_EQ(error_of(frame, {.bonds = 1.5, .unwrap = true}), "");
  frame.cell = ParticleCell{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {}, each_way};
  EXPECT_EQ(error_of(frame, {.bonds = 1.5, .unwrap = true}),
            "unwrap: the vectors of the file's cell lie in a plane or a line");
  frame.cell = cell_of_ten;
  frame.cell->periodic = {};
  EXPECT_THAT(notes_of(frame, {.bonds = 1.5, .unwrap = true}),
              HasSubstr("molecules stay as they are"));
}

}  // namespace
}  // namespace boule
