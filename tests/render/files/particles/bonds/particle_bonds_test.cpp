#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particles/particle_frames.h"

// Which bonds particles have, and how they and the balls look.

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of;
using test::row_of_particles;
using test::row_with;
using test::spheres_of;
using test::text_column;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<Capsule> capsules_of(const ParticleFrame& frame, const ParticleStyle& style,
                                 const Vec3d& origin = {}) {
  std::vector<Capsule> capsules;
  const auto made = ParticleSpheres::make(frame, style);
  EXPECT_TRUE(made.ok()) << format_diagnostic(made.error());
  if (made) EXPECT_TRUE(made.value().append_capsules_to(capsules, origin).ok());
  return capsules;
}

std::size_t bonds_of(const ParticleFrame& frame, const BondChoice& bonds) {
  const auto made = ParticleSpheres::make(frame, {.bonds = bonds});
  return made ? made.value().bonds() : 999;
}

ParticleFrame molecule(const std::vector<std::string>& species, std::vector<Vec3d> positions) {
  ParticleFrame frame;
  frame.positions = std::move(positions);
  frame.species = text_column("element", species);
  return frame;
}

/// Two molecules of water, whose hydrogen bond is short.
ParticleFrame water() {
  return molecule(
      {"O", "H", "H", "O", "H", "H"},
      {{0, 0, 0}, {0.96, 0, 0}, {-0.24, 0.93, 0}, {2.3, 0, 0}, {2.6, 0.9, 0}, {2.6, -0.9, 0}});
}

ParticleFrame with_bonds(ParticleFrame frame, std::vector<ParticleBond> bonds, bool all = true) {
  frame.bonds = std::move(bonds);
  frame.lists_all_bonds = all;
  return frame;
}

std::vector<float> shape_radii_of(const ParticleFrame& frame, const ParticleStyle& style) {
  std::vector<float> radii;
  for (const Sphere& sphere : spheres_of(frame, style)) radii.push_back(sphere.radius);
  return radii;
}

TEST(ParticleBonds, WaterByCovalentRadii) {
  EXPECT_EQ(bonds_of(water(), BondRule::distance), 4U);
  EXPECT_EQ(bonds_of(water(), BondRule::automatic), 4U);
  EXPECT_EQ(bonds_of(water(), BondRule::none), 0U);
  EXPECT_EQ(bonds_of(water(), 1.4), 5U);
  ParticleFrame in_nm = water();
  for (Vec3d& position : in_nm.positions) position = position * 0.1;
  in_nm.length_in_angstrom = 10;
  EXPECT_EQ(bonds_of(in_nm, BondRule::distance), 4U);
}

TEST(ParticleBonds, HydrogensOfMethyleneStayApart) {
  EXPECT_EQ(bonds_of(molecule({"C", "H", "H"}, {{0, 0, 0}, {0.89, 0.63, 0}, {-0.89, 0.63, 0}}),
                     BondRule::distance),
            2U);
}

TEST(ParticleBonds, SaltsHaveNone) {
  EXPECT_EQ(bonds_of(molecule({"Na", "Cl", "Ca2+"}, {{0, 0, 0}, {2.8, 0, 0}, {2.8, 2.3, 0}}),
                     BondRule::distance),
            0U);
  EXPECT_EQ(bonds_of(molecule({"Ti", "O"}, {{0, 0, 0}, {1.95, 0, 0}}), BondRule::distance), 1U);
}

TEST(ParticleBonds, TwoAtOnePlaceAreNone) {
  EXPECT_EQ(bonds_of(molecule({"C", "C"}, {{0, 0, 0}, {0.39, 0, 0}}), BondRule::distance), 0U);
  EXPECT_EQ(bonds_of(molecule({"C", "C"}, {{0, 0, 0}, {0.41, 0, 0}}), BondRule::distance), 1U);
}

TEST(ParticleBonds, ContactsAreOfWholeRadii) {
  const ParticleFrame grains = row_with("radius", {0.5, 0.6, 0.3, 0.3});
  EXPECT_EQ(bonds_of(grains, BondRule::contacts), 1U);
  ParticleStyle style{.bonds = BondRule::contacts};
  EXPECT_THAT(shape_radii_of(grains, style), ElementsAre(0.25F, 0.3F, 0.15F, 0.15F));
  style.shape = ParticleShape::space_filling;
  EXPECT_THAT(shape_radii_of(grains, style), ElementsAre(0.5F, 0.6F, 0.3F, 0.3F));
}

TEST(ParticleBonds, FilesComeFirst) {
  EXPECT_EQ(bonds_of(with_bonds(water(), {{0, 3}}), BondRule::automatic), 1U);
  EXPECT_EQ(bonds_of(with_bonds(water(), {{0, 3}}), BondRule::file), 1U);
  EXPECT_EQ(bonds_of(with_bonds(water(), {{0, 3}}), BondRule::distance), 4U);
  EXPECT_EQ(bonds_of(with_bonds(row_of({"1", "2"}), {{0, 1}}, false), BondRule::automatic), 1U);
}

TEST(ParticleBonds, DistanceFillsWhatFilesLeaveOut) {
  // The file lists those of the first molecule only, one too few.
  EXPECT_EQ(bonds_of(with_bonds(water(), {{0, 1}}, false), BondRule::automatic), 4U);
  EXPECT_EQ(bonds_of(with_bonds(water(), {{0, 1}, {1, 2}}, false), BondRule::automatic), 4U);
}

TEST(ParticleBonds, SelectionKeepsWholeBondsOnly) {
  const ParticleFrame chain = with_bonds(row_of({"C", "N", "C", "O"}), {{0, 1}, {1, 2}, {2, 3}});
  const auto made = ParticleSpheres::make(chain, {.bonds = BondRule::file, .select = "x > 0"});
  EXPECT_EQ(made.value().bonds(), 2U);
  const auto capsules = capsules_of(chain, {.bonds = BondRule::file, .select = "species != 'N'"});
  ASSERT_EQ(capsules.size(), 2U);
  EXPECT_EQ(capsules[0].a.x, 2);
  EXPECT_EQ(capsules[1].b.x, 3);
}

TEST(ParticleBonds, WhatFilesLackIsAnError) {
  EXPECT_THAT(error_of(row_of_particles(2), {.bonds = BondRule::distance}),
              HasSubstr("bonds: bonds by distance need elements"));
  EXPECT_THAT(error_of(row_of({"1", "2"}), {.bonds = BondRule::distance}),
              HasSubstr("need elements"));
  EXPECT_EQ(error_of(water(), {.bonds = BondRule::file}), "bonds: the file lists no bonds");
  EXPECT_THAT(error_of(water(), {.radius = 1.0, .shape = ParticleShape::sticks}),
              HasSubstr("radius: sticks have one radius"));
  EXPECT_EQ(error_of(water(), {.cell_edges = true}), "cell_edges: the file tells no cell to draw");
  EXPECT_EQ(bonds_of(row_of_particles(2), BondRule::automatic), 0U);
  EXPECT_EQ(bonds_of(ParticleFrame(), BondRule::file), 0U);
}

/// From the corner of the cell, or of the box around the spheres, a quarter of the longest side of
/// either.
TEST(ParticleBonds, AxesStandAtACorner) {
  const auto expect_axes = [](const ParticleFrame& frame, const Vec3f& corner, float length) {
    const auto axes = capsules_of(frame, {.radius = 1.0, .axes = true}, {0, 0, 2});
    ASSERT_EQ(axes.size(), 3U);
    EXPECT_EQ(axes[0].b - axes[0].a, (Vec3f{length, 0, 0}));
    EXPECT_EQ(axes[1].b - axes[1].a, (Vec3f{0, length, 0}));
    EXPECT_EQ(axes[2].b - axes[2].a, (Vec3f{0, 0, length}));
    for (const Capsule& axis : axes) EXPECT_EQ(axis.a, corner);
    EXPECT_EQ(hex_text(axes[0].material.color()), "#d82828");
    EXPECT_EQ(hex_text(axes[2].material.color()), "#2850d8");
  };
  ParticleFrame frame = row_of_particles(4);  // a box of 5 x 2 x 2
  expect_axes(frame, {-1, -1, -3}, 1.25F);
  frame.cell = ParticleCell{{4, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-2, 3, 4}, {}};
  expect_axes(frame, {-2, 3, 2}, 1.25F);
  frame.cell->b = {0, 8, 0};
  expect_axes(frame, {-2, 3, 2}, 2);
  EXPECT_THAT(capsules_of(ParticleFrame(), {.axes = true}), IsEmpty());
}

TEST(ParticleBonds, SmallMoleculesWithBondsStartWithThem) {
  const auto bonded = with_bonds(water(), {{0, 1}, {0, 2}, {3, 4}, {3, 5}});
  EXPECT_EQ(capsules_of(bonded, {}).size(), 8U);
  EXPECT_THAT(shape_radii_of(bonded, {}), Each(testing::Lt(0.5F)));
  EXPECT_THAT(notes_of(bonded), HasSubstr("balls and sticks"));
  // Not if most have none, if radii are given, or if nobody wants bonds.
  EXPECT_THAT(capsules_of(with_bonds(water(), {{0, 1}}), {}), IsEmpty());
  EXPECT_THAT(capsules_of(bonded, {.radius = RadiusTable::vdw}), IsEmpty());
  EXPECT_THAT(capsules_of(bonded, {.bonds = BondRule::none}), IsEmpty());
  EXPECT_THAT(capsules_of(bonded, {.shape = ParticleShape::space_filling}), IsEmpty());
  EXPECT_THAT(shape_radii_of(bonded, {.bonds = BondRule::none}), Each(testing::Gt(1.1F)));
}

TEST(ParticleBonds, WithoutListedBondsNothingChanges) {
  EXPECT_THAT(capsules_of(water(), {}), IsEmpty());
  EXPECT_THAT(shape_radii_of(water(), {}), Each(testing::Gt(1.1F)));
  EXPECT_THAT(notes_of(water()), Not(HasSubstr("bonds")));
}

TEST(ParticleBonds, SticksAreOfOneRadius) {
  const ParticleStyle style{.shape = ParticleShape::sticks, .bond_radius = 0.3};
  EXPECT_THAT(shape_radii_of(water(), style), Each(0.3F));
  const auto capsules = capsules_of(water(), style);
  ASSERT_EQ(capsules.size(), 8U);
  EXPECT_EQ(capsules[0].radius, 0.3F);
  EXPECT_EQ(capsules[0].b.x, 0.48F);
}

TEST(ParticleBonds, GivenRadiiStayAsTheyAre) {
  const ParticleStyle style{
      .radius = 0.4, .shape = ParticleShape::balls_and_sticks, .bond_radius = 0.1};
  EXPECT_THAT(shape_radii_of(water(), style), Each(0.4F));
  const ParticleStyle oxygen{.radii = {{"O", 0.7}}, .shape = ParticleShape::balls_and_sticks};
  EXPECT_EQ(shape_radii_of(water(), oxygen)[0], 0.7F);
  EXPECT_LT(shape_radii_of(water(), oxygen)[1], 0.5F);
}

TEST(ParticleBonds, HaveTheColorThatIsGiven) {
  const SrgbColor white{0xff, 0xff, 0xff};
  const auto capsules =
      capsules_of(water(), {.material = 3, .shape = ParticleShape::sticks, .bond_color = white});
  ASSERT_EQ(capsules.size(), 4U);
  EXPECT_EQ(capsules[0].material, MaterialRef::colored(3, white));
}

TEST(ParticleBonds, ArrowsAreVectors) {
  ParticleFrame frame = row_with("fx", {1, 0, 2});
  frame.numbers.push_back({"fy", {0, 0, std::numeric_limits<double>::quiet_NaN()}});
  frame.numbers.push_back({"fz", {-1, 0, 2}});
  const ParticleStyle style{
      .radius = 0.1, .bond_radius = 0.05, .arrows = ArrowColumns{{"fx", "fy", "fz"}, 2}};
  const auto capsules = capsules_of(frame, style, {1, 0, 0});
  ASSERT_EQ(capsules.size(), 1U);  // neither of zeros nor of what is missing
  EXPECT_EQ(capsules[0].a, (Vec3f{-1, 0, 0}));
  EXPECT_EQ(capsules[0].b, (Vec3f{1, 0, -2}));
  EXPECT_EQ(capsules[0].radius, 0.05F);
  EXPECT_THAT(error_of(frame, {.arrows = ArrowColumns{{"vx", "fy", "fz"}}}),
              HasSubstr("arrows: there is no column 'vx'"));
}

TEST(ParticleBonds, SeriesKeepTheirLook) {
  const auto bonded = with_bonds(water(), {{0, 1}, {0, 2}, {3, 4}, {3, 5}});
  ParticleChoices all = ParticleSpheres::make(bonded, {}).value().own_choices();
  const ParticleChoices same = all;
  all.add(same);
  EXPECT_EQ(all.starts_bonded, true);
  all.add(ParticleSpheres::make(water(), {}).value().own_choices());
  EXPECT_EQ(all.starts_bonded, false);
  EXPECT_TRUE(all.radii_differ);
  all.finish("all 3 frames");
  EXPECT_THAT(capsules_of(bonded, {.chosen = &all}), IsEmpty());
  // Where there are no elements, the smallest radius of all frames makes the bonds.
  const ParticleStyle style{.bonds = BondRule::contacts};
  const auto first = row_with("radius", {0.6, 0.6}), second = row_with("radius", {0.8, 0.8});
  ParticleChoices grains = ParticleSpheres::make(first, style).value().own_choices();
  grains.add(ParticleSpheres::make(second, style).value().own_choices());
  grains.finish("all 2 frames");
  const ParticleStyle of_series{.chosen = &grains, .bonds = BondRule::contacts};
  EXPECT_EQ(capsules_of(second, of_series)[0].radius, capsules_of(first, style)[0].radius);
}

TEST(ParticleBonds, AxesOfSeriesFollowAllFrames) {
  const auto at = [](const Vec3d& a, const Vec3d& b) {
    ParticleFrame frame;
    frame.positions = {a, b};
    return frame;
  };
  const ParticleStyle style{.radius = 0.5, .axes = true};
  const auto first = at({0, 0, 0}, {3, 0, 0}), second = at({5, 2, 1}, {7, 2, 1});
  ParticleChoices all = ParticleSpheres::make(first, style).value().own_choices();
  EXPECT_TRUE(all.is_open());
  all.add(ParticleSpheres::make(second, style).value().own_choices());
  all.finish("all 2 frames");
  const ParticleStyle of_series{.radius = 0.5, .chosen = &all, .axes = true};
  for (const ParticleFrame& frame : {first, second}) {
    const auto axes = capsules_of(frame, of_series);
    ASSERT_EQ(axes.size(), 3U);
    EXPECT_EQ(axes[0].a, (Vec3f{-0.5, -0.5, -0.5}));
    EXPECT_EQ(axes[0].b, (Vec3f{1.5, -0.5, -0.5}));  // a quarter of 8
  }
  EXPECT_THAT(capsules_of(ParticleFrame(), of_series), IsEmpty());
}

}  // namespace
}  // namespace boule
