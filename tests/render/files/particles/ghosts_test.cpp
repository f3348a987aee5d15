// Particles that one sees through.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::row_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// The indices of the materials of the primitives that a frame becomes.
template <class Primitive>
std::vector<std::uint32_t> materials_of(const std::vector<Primitive>& primitives) {
  std::vector<std::uint32_t> indices;
  for (const Primitive& one : primitives) indices.push_back(one.material.index());
  return indices;
}

ParticleStyle ghosts(const std::string& which) {
  ParticleStyle style;
  style.material = 2;
  style.ghost = which;
  style.ghost_material = 5;
  return style;
}

TEST(ParticleGhosts, HaveTheirMaterialAndTheirColors) {
  const ParticleFrame frame = row_of({"C", "O", "C"});
  const std::vector<Sphere> plain = test::spheres_of(frame, {.material = 2});
  const std::vector<Sphere> some = test::spheres_of(frame, ghosts("species == 'O'"));
  EXPECT_THAT(materials_of(some), ElementsAre(2, 5, 2));
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(some[i].material.color(), plain[i].material.color());
  ParticleStyle style = ghosts("x >= 1");
  style.select = "x != 1";
  style.replicate = {2, 1, 1};
  ParticleFrame cell = frame;
  cell.cell = ParticleCell{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {}, {true, true, true}};
  EXPECT_THAT(materials_of(test::spheres_of(cell, style)), ElementsAre(2, 5, 2, 5));
  ParticleFrame bare = test::row_of_particles(2);
  EXPECT_FALSE(test::spheres_of(bare, ghosts("x == 1"))[1].material.has_color());
  EXPECT_THAT(materials_of(test::spheres_of(bare, ghosts("x == 1"))), ElementsAre(2, 5));
}

TEST(ParticleGhosts, BondsFollowTheirEnds) {
  ParticleStyle style = ghosts("x >= 1");
  style.bonds = 1.5;
  for (const bool in_one_color : {false, true}) {
    if (in_one_color) style.bond_color = SrgbColor{1, 2, 3};
    const auto made = ParticleSpheres::make(row_of({"C", "C", "C"}), style);
    ASSERT_TRUE(made);
    std::vector<Capsule> bonds;
    ASSERT_TRUE(made.value().append_capsules_to(bonds, {}));
    EXPECT_THAT(materials_of(bonds), ElementsAre(2, 5, 5));
    if (in_one_color) EXPECT_EQ(bonds[1].material.color(), (SrgbColor{1, 2, 3}));
  }
}

TEST(ParticleGhosts, MistakesAreNamed) {
  ParticleFrame frame = row_of({"C", "O"});
  frame.texts = {test::text_column("chain", {"A", "B"})};
  EXPECT_THAT(error_of(frame, ghosts("chian == 'A'")),
              testing::AllOf(HasSubstr("ghost: "), HasSubstr("did you mean 'chain'?")));
  EXPECT_THAT(error_of(frame, ghosts("x >=")), HasSubstr("ghost: "));
  EXPECT_EQ(error_of(frame, ghosts("x > 9")), "");
}

}  // namespace
}  // namespace boule
