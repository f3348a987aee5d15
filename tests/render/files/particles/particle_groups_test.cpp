#include "render/files/particles/particle_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/render/files/particles/particle_frames.h"

// Which particles an outline goes around together.

namespace boule {
namespace {

using test::error_of;
using test::row_of;
using test::row_of_particles;
using test::text_column;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The groups of a frame's spheres and capsules.
OutlineGroups groups_of(const ParticleFrame& frame, const ParticleStyle& style) {
  OutlineGroups groups;
  const auto made = ParticleSpheres::make(frame, style);
  EXPECT_TRUE(made.ok()) << format_diagnostic(made.error());
  if (!made) return groups;
  std::vector<Capsule> capsules;
  EXPECT_TRUE(made.value().append_capsules_to(capsules, {}, &groups).ok());
  EXPECT_TRUE(made.value().append_groups_to(groups, 0).ok());
  return groups;
}

/// Two waters, the second bonded through the face of a cell of 4 x 9 x 9.
ParticleFrame waters() {
  ParticleFrame frame;
  frame.positions = {{1, 1, 1},   {1.96, 1, 1}, {0.04, 1, 1},
                     {3.8, 5, 5}, {0.76, 5, 5}, {2.84, 5, 5}};
  frame.species = text_column("element", {"O", "H", "H", "O", "H", "H"});
  frame.cell = ParticleCell{{4, 0, 0}, {0, 9, 0}, {0, 0, 9}, {}, {true, true, true}};
  return frame;
}

TEST(ParticleGroups, AreNoneUnlessAskedFor) {
  EXPECT_TRUE(groups_of(row_of({"A", "B"}), {}).empty());
  EXPECT_TRUE(groups_of(row_of({"A", "B"}), {.outline_by = OutlineRule::object}).empty());
  EXPECT_TRUE(groups_of(ParticleFrame(), {.outline_by = OutlineRule::chain}).empty());
  const OutlineGroups of_sticks = groups_of(waters(), {.shape = ParticleShape::sticks});
  EXPECT_THAT(of_sticks.spheres, ElementsAre(1, 1, 1, 1, 1, 1));
  EXPECT_THAT(of_sticks.capsules, testing::Each(1));
}

TEST(ParticleGroups, AreKindsColumnsAndResidues) {
  ParticleFrame frame = row_of({"C", "O", "C", "O"});
  frame.texts = {text_column("chain", {"A", "A", "B", "B"}),
                 text_column("resname", {"X", "X", "X", "X"})};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  frame.numbers = {{"resid", {1, 2, 2, 2}}, {"cluster", {0, -0.0, 1e300, nan}}};
  const auto by = [&](const OutlineChoice& outline) {
    return groups_of(frame, {.outline_by = outline}).spheres;
  };
  EXPECT_THAT(by(OutlineRule::kind), ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(by(OutlineRule::chain), ElementsAre(1, 1, 2, 2));
  EXPECT_THAT(by(OutlineRule::residue), ElementsAre(1, 2, 3, 3));
  EXPECT_THAT(by("cluster"), ElementsAre(1, 1, 2, 3));
  EXPECT_THAT(by("resname"), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(by(OutlineRule::depth), ElementsAre(1, 1, 1, 1));
  frame.numbers.push_back({"mol", {7, 8, 8, 7}});
  EXPECT_THAT(by(OutlineRule::molecule), ElementsAre(1, 2, 2, 1));
}

TEST(ParticleGroups, OfMoleculesFollowBonds) {
  ParticleFrame frame = waters();
  frame.cell.reset();
  frame.positions[4].x = 4.76;
  const ParticleStyle style{.outline_by = OutlineRule::molecule};
  EXPECT_THAT(groups_of(frame, style).spheres, ElementsAre(1, 1, 1, 2, 2, 2));
  ParticleStyle sticks = style;
  sticks.shape = ParticleShape::sticks;
  EXPECT_THAT(groups_of(frame, sticks).capsules, ElementsAre(1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(groups_of(row_of_particles(1), style).spheres, ElementsAre(1));
  EXPECT_THAT(error_of(row_of_particles(2), style),
              HasSubstr("outline_by: the file tells no molecules"));
}

TEST(ParticleGroups, OfImagesDiffer) {
  ParticleFrame frame = waters();
  frame.texts = {text_column("chain", {"A", "A", "A", "B", "B", "B"})};
  ParticleStyle style{.outline_by = OutlineRule::chain, .replicate = {2, 1, 1}};
  const OutlineGroups chains = groups_of(frame, style);
  EXPECT_THAT(chains.spheres, ElementsAre(1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4));
  EXPECT_EQ(chains.largest, 4U);
  for (const OutlineRule rule : {OutlineRule::kind, OutlineRule::molecule}) {
    style.outline_by = rule;
    const OutlineGroups same = groups_of(frame, style);
    EXPECT_TRUE(
        std::equal(same.spheres.begin(), same.spheres.begin() + 6, same.spheres.begin() + 6));
    EXPECT_EQ(same.largest, 2U);
  }
}

TEST(ParticleGroups, SplitBondsInHalves) {
  ParticleFrame frame = row_of({"C", "C"});
  frame.numbers = {{"resid", {1, 2}}};
  ParticleStyle style{.shape = ParticleShape::sticks, .outline_by = OutlineRule::residue};
  style.bonds = 1.5;
  EXPECT_THAT(groups_of(frame, style).capsules, ElementsAre(1, 2));
  style.outline_by = OutlineRule::object;
  EXPECT_THAT(groups_of(frame, style).capsules, IsEmpty());
  style.outline_by = {};
  EXPECT_THAT(groups_of(frame, style).capsules, ElementsAre(1));
}

TEST(ParticleGroups, RefuseWhatTheFileLacks) {
  ParticleFrame frame = row_of({"C", "O"});
  frame.numbers = {{"cluster", {1, 2}}};
  const auto error = [&](const OutlineChoice& outline) {
    return error_of(frame, {.outline_by = outline});
  };
  EXPECT_THAT(error(OutlineRule::chain), HasSubstr("outline_by: there is no column 'chain'"));
  EXPECT_THAT(error(OutlineRule::residue), HasSubstr("outline_by: there is no column 'resid'"));
  EXPECT_THAT(error("clusters"), HasSubstr("did you mean 'cluster'?"));
  EXPECT_THAT(error("molecul"), HasSubstr("did you mean 'molecule'?"));
}

}  // namespace
}  // namespace boule
