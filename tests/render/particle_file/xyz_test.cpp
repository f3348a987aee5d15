#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/particle_file/read_text.h"

namespace boule {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;

TEST(Xyz, ReadsPlainFrames) {
  const auto read = read_particles("run.xyz", "2\nwater {\" =\nH 1 -2.5 3e-1 7 x\r\nO 0 0 0 8 y");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 2U);
  EXPECT_EQ(frame.positions[0].x, 1);
  EXPECT_EQ(frame.positions[0].y, -2.5);
  EXPECT_EQ(frame.positions[0].z, 0.3);
  ASSERT_TRUE(frame.species.has_value());
  EXPECT_THAT(frame.species->texts, ElementsAre("H", "O"));
  EXPECT_THAT(frame.species->indices, ElementsAre(0, 1));
  const NumberColumn* c4 = find_number_column(frame, "c4");
  ASSERT_NE(c4, nullptr);
  EXPECT_THAT(c4->values, ElementsAre(7, 8));
  const TextColumn* c5 = find_text_column(frame, "c5");
  ASSERT_NE(c5, nullptr);
  EXPECT_THAT(c5->texts, ElementsAre("x", "y"));
  EXPECT_FALSE(frame.cell.has_value());
}

TEST(Xyz, ReadsPropertiesAndCell) {
  const auto read = read_particles(
      "run.extxyz",
      "1\nProperties=species:S:1:pos:R:3:vel:R:3:force:R:3:radius:R:1:fixed:L:1:n:I:2:tag:S:1 "
      "Lattice=\"1 2 3 4 5 6 7 8 9\" Origin='1 0 -1' pbc={T False 1} Time=2.5 note=\"a \\\" b\" x\n"
      "Fe 1 2 3 4 5 6 7 8 9 0.5 T 10 11 a\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  std::vector<std::string> names;
  for (const NumberColumn& column : frame.numbers) names.push_back(column.name);
  EXPECT_THAT(names, ElementsAre("vx", "vy", "vz", "force_x", "force_y", "force_z", "radius",
                                 "fixed", "n_1", "n_2"));
  EXPECT_THAT(frame.numbers[7].values, ElementsAre(1));
  EXPECT_THAT(frame.numbers[9].values, ElementsAre(11));
  ASSERT_EQ(frame.texts.size(), 1U);
  EXPECT_EQ(frame.texts[0].name, "tag");
  ASSERT_TRUE(frame.cell.has_value());
  EXPECT_EQ(frame.cell->b.y, 5);
  EXPECT_EQ(frame.cell->c.z, 9);
  EXPECT_EQ(frame.cell->origin.z, -1);
  EXPECT_THAT(frame.cell->periodic, ElementsAre(true, false, true));
  EXPECT_EQ(frame.time, 2.5);
}

TEST(Xyz, KeepsWantedColumnsOnly) {
  ParticleFileOptions options;
  options.wanted = std::vector<std::string>{"c5"};
  const auto read = read_particles("run.xyz", "1\n\nH 1 2 3 nan 5\n", options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().numbers.size(), 1U);
  EXPECT_EQ(read.value().numbers[0].name, "c5");
  EXPECT_THAT(read.value().unread, ElementsAre("c4"));
}

TEST(Xyz, ErrorsHaveLineColumnAndName) {
  EXPECT_EQ(particle_error("a.xyz", "2\n\nH 1 2 3\nH 1 nan 3\n"),
            "4:5: expected a finite number, found 'nan' (y)");
  EXPECT_EQ(particle_error("a.xyz", "1000000000000\n\nH 1 2 3\n"),
            "1:1: it promises 1000000000000 particles, the file ends after 1 (count)");
}

}  // namespace
}  // namespace boule
