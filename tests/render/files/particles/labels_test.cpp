// Texts of particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::row_of;
using test::row_of_particles;
using test::text_column;
using testing::ElementsAre;
using testing::HasSubstr;

ParticleFrame residues() {
  ParticleFrame frame = row_of({"C", "N", "C"});
  frame.texts = {text_column("name", {"CA", "N", "CB"}),
                 text_column("resname", {"ALA", "GLY", ""})};
  frame.numbers = {{"resid", {4, 5, 6}}, {"q", {0.25, -1.5, 1e-7}}};
  return frame;
}

std::vector<std::string> texts_of(const ParticleFrame& frame, const LabelRule& rule,
                                  const std::string& select = {}) {
  ParticleStyle style;
  style.labels = rule;
  style.select = select;
  const auto made = ParticleSpheres::make(frame, style);
  EXPECT_TRUE(made) << made.error().message;
  std::vector<std::string> texts;
  if (!made) return texts;
  for (const ParticleLabel& one : made.value().labels()) texts.push_back(one.text);
  return texts;
}

TEST(Labels, HaveTheTextsOfColumns) {
  const ParticleFrame frame = residues();
  EXPECT_THAT(texts_of(frame, {}), ElementsAre());
  EXPECT_THAT(texts_of(frame, {"x >= 0"}), ElementsAre("CA", "N", "CB"));
  EXPECT_THAT(texts_of(frame, {"name == 'CA'", {"resname", "resid"}}), ElementsAre("ALA 4"));
  EXPECT_THAT(texts_of(frame, {"x >= 0", {"q"}}), ElementsAre("0.25", "-1.5", "1e-07"));
  EXPECT_THAT(texts_of(frame, {"x > 1", {"resname"}}), ElementsAre("missing"));
  EXPECT_THAT(texts_of(row_of({"C", "N"}), {"x > 0"}), ElementsAre("N"));
  EXPECT_THAT(texts_of(row_of_particles(3), {"x > 0"}), ElementsAre("2", "3"));
}

TEST(Labels, AreOfShownParticlesWhereTheyAre) {
  ParticleFrame frame = residues();
  EXPECT_THAT(texts_of(frame, {"x >= 0", {"resid"}}, "name != 'N'"), ElementsAre("4", "6"));
  frame.cell = ParticleCell{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0.5, 0, 0}, {true, true, true}};
  ParticleStyle style;
  style.radius = 0.25;
  style.labels = {"resid == 4"};
  style.wrap = true;
  const auto made = ParticleSpheres::make(frame, style);
  ASSERT_TRUE(made);
  ASSERT_EQ(made.value().labels().size(), 1U);
  EXPECT_EQ(made.value().labels()[0].position, (Vec3d{2, 0, 0}));
  EXPECT_EQ(made.value().labels()[0].radius, 0.25);
}

TEST(Labels, WrongOnesAreRefused) {
  const auto refused = [](const ParticleFrame& frame, const LabelRule& rule) {
    ParticleStyle style;
    style.labels = rule;
    return error_of(frame, style);
  };
  EXPECT_THAT(refused(residues(), {"nam == 'CA'"}), HasSubstr("labels: "));
  EXPECT_THAT(refused(residues(), {"x >="}), HasSubstr("labels: "));
  EXPECT_THAT(refused(residues(), {"x >= 0", {"resnam"}}),
              HasSubstr("label_text: there is no column 'resnam'; did you mean 'resname'?"));
  EXPECT_THAT(refused(row_of_particles(501), {"x >= 0"}),
              HasSubstr("labels: 501 particles would have a label, 500 at most can"));
  EXPECT_EQ(refused(row_of_particles(501), {"x > 0"}), "");
}

TEST(Labels, AskForTheirColumns) {
  ParticleStyle style;
  style.labels = {"chain == 'A' && name == 'CA'", {"resid"}};
  const auto names = columns_of(style);
  for (const char* name : {"chain", "name", "resid"})
    EXPECT_THAT(names, testing::Contains(std::string(name)));
}

}  // namespace
}  // namespace boule
