#include "render/files/particles/bonds/bond_capsules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/number_text.h"
#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const MaterialRef red = MaterialRef::colored(0, {0xff, 0, 0});
const MaterialRef blue = MaterialRef::colored(0, {0, 0, 0xff});

/// "X1 X2 MATERIAL" of capsules along x: 'r', 'b', or '-' for others.
std::vector<std::string> along_x(const std::vector<Capsule>& capsules) {
  std::vector<std::string> texts;
  for (const Capsule& one : capsules) {
    const char* const material = one.material == red ? "r" : one.material == blue ? "b" : "-";
    // Where a face cuts them is rounded.
    const auto place = [](float x) {
      return number_text(std::round(static_cast<double>(x) * 1e5) / 1e5 + 0.0);
    };
    texts.push_back(place(one.a.x) + " " + place(one.b.x) + " " + material);
  }
  return texts;
}

struct Drawn {
  std::vector<Vec3d> positions{};
  std::vector<float> radii{1, 1};
  std::vector<MaterialRef> materials{red, blue};
  std::optional<ParticleCell> cell{};
  std::array<int, 3> images{1, 1, 1};
  Vec3d origin{};

  [[nodiscard]] std::vector<Capsule> bonds(const std::vector<Bond>& bonds,
                                           std::optional<MaterialRef> all = {}) const {
    const ParticleValues<float> of_radii{radii};
    const ParticleValues<MaterialRef> of_materials{materials};
    const CellImages shown(cell.value_or(ParticleCell()), images);
    std::vector<Capsule> capsules;
    append_bonds({positions, of_radii, of_materials, cell, shown, origin}, bonds, {0.25F, all},
                 capsules);
    return capsules;
  }
};

ParticleCell box_of(double side) {
  return {.a = {side, 0, 0}, .b = {0, side, 0}, .c = {0, 0, side}, .periodic = {true, true, true}};
}

TEST(BondCapsules, HalvesHaveTheirColors) {
  const auto capsules = Drawn{{{0, 0, 0}, {4, 0, 0}}}.bonds({{0, 1, {}}});
  EXPECT_THAT(along_x(capsules), ElementsAre("0 2 r", "2 4 b"));
  EXPECT_EQ(capsules[0].radius, 0.25F);
}

TEST(BondCapsules, HalvesMeetBetweenTheSpheres) {
  const Drawn drawn{.positions = {{0, 0, 0}, {4, 0, 0}}, .radii = {2, 1}};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {}}})), ElementsAre("0 2.5 r", "2.5 4 b"));
  const Drawn inside{.positions = {{0, 0, 0}, {4, 0, 0}}, .radii = {20, 1}};
  EXPECT_THAT(along_x(inside.bonds({{0, 1, {}}})), ElementsAre("0 4 r"));
}

TEST(BondCapsules, OneColorIsOneCapsule) {
  const Drawn drawn{.positions = {{0, 0, 0}, {4, 0, 0}}, .materials = {red, red}};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {}}})), ElementsAre("0 4 r"));
  const Drawn two{{{0, 0, 0}, {4, 0, 0}}};
  EXPECT_THAT(along_x(two.bonds({{0, 1, {}}}, blue)), ElementsAre("0 4 b"));
}

TEST(BondCapsules, FacesCutBonds) {
  const Drawn drawn{.positions = {{1, 5, 5}, {9, 5, 5}}, .cell = box_of(10)};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {-1, 0, 0}}})), ElementsAre("1 0 r", "10 9 b"));
}

TEST(BondCapsules, PiecesKeepBothColors) {
  const Drawn drawn{.positions = {{3, 5, 5}, {9, 5, 5}}, .cell = box_of(10)};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {-1, 0, 0}}})), ElementsAre("3 1 r", "1 0 b", "10 9 b"));
}

TEST(BondCapsules, OutsideOfTheCellHalvesRemain) {
  const Drawn drawn{.positions = {{-3, 5, 5}, {5, 5, 5}}, .cell = box_of(10)};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {-1, 0, 0}}})), ElementsAre("-3 -4 r", "6 5 b"));
}

TEST(BondCapsules, ImagesJoinTheirBonds) {
  const Drawn drawn{.positions = {{1, 5, 5}, {9, 5, 5}},
                    .materials = {red, red},
                    .cell = box_of(10),
                    .images = {2, 1, 1}};
  EXPECT_THAT(along_x(drawn.bonds({{0, 1, {-1, 0, 0}}})),
              ElementsAre("1 0 r", "11 9 r", "20 19 r"));
  EXPECT_THAT(along_x(drawn.bonds({{0, 0, {1, 0, 0}}})), ElementsAre("1 11 r", "0 1 r", "11 20 r"));
}

TEST(BondCapsules, EndsAreTheSpheresCentres) {
  const Drawn drawn{.positions = {{1e6 + 0.1, 0.7, 0.1}, {1e6 + 1.3, 0.2, 0.3}},
                    .cell = box_of(1.7),
                    .images = {3, 2, 2},
                    .origin = {1e6, 0.3, 0.5}};
  const auto capsules = drawn.bonds({{0, 1, {}}});
  const CellImages images(*drawn.cell, drawn.images);
  ASSERT_EQ(capsules.size(), 2 * images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto center = [&](std::size_t particle) {
      return vec_cast<float>((drawn.positions[particle] - drawn.origin) + images.shift(i));
    };
    EXPECT_EQ(capsules[2 * i].a, center(0));
    EXPECT_EQ(capsules[2 * i].b, capsules[2 * i + 1].a);
    EXPECT_EQ(capsules[2 * i + 1].b, center(1));
  }
}

TEST(BondCapsules, BoxesHaveTwelveEdges) {
  Drawn drawn{.cell = box_of(2), .images = {3, 1, 1}};
  const ParticleValues<float> radii{{1}};
  const ParticleValues<MaterialRef> materials{{red}};
  const auto edges = [&] {
    const CellImages shown(*drawn.cell, drawn.images);
    std::vector<Capsule> capsules;
    append_cell_edges({drawn.positions, radii, materials, drawn.cell, shown, {1, 0, 0}},
                      {0.1F, blue}, capsules);
    return capsules;
  };
  ASSERT_EQ(edges().size(), 12U);
  EXPECT_EQ(edges()[0].a, (Vec3f{-1, 0, 0}));
  EXPECT_EQ(edges()[0].b, (Vec3f{5, 0, 0}));
  EXPECT_EQ(edges()[2].a, (Vec3f{-1, 2, 2}));
  drawn.cell->c = {};
  EXPECT_EQ(edges().size(), 8U);
}

}  // namespace
}  // namespace boule
