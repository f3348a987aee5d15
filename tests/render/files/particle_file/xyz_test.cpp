#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particle_file/read_text.h"

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
  EXPECT_FALSE(frame.axes_matter);
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
  EXPECT_TRUE(frame.axes_matter);
  EXPECT_EQ(frame.cell->b.y, 5);
  EXPECT_EQ(frame.cell->c.z, 9);
  EXPECT_EQ(frame.cell->origin.z, -1);
  EXPECT_THAT(frame.cell->periodic, ElementsAre(true, false, true));
  EXPECT_EQ(frame.time, 2.5);
}

std::vector<std::string> species(const Result<ParticleFrame>& read) {
  EXPECT_TRUE(read.ok()) << format_diagnostic(read.error());
  std::vector<std::string> found;
  if (!read || !read.value().species) return found;
  for (const std::uint32_t i : read.value().species->indices) {
    found.push_back(read.value().species->texts[i]);
  }
  return found;
}

TEST(Xyz, NumbersAreElementsUnlessTheyAreTypes) {
  const std::string note =
      "the species are taken as atomic numbers; columns named type,x,y,z make them types";
  const std::string rows = "8 0 0 0\n1 1 0 0\n26 3 0 0\n0 4 0 0\n";
  const auto elements = read_particles("a.xyz", "4\n\n" + rows);
  EXPECT_THAT(species(elements), ElementsAre("O", "H", "Fe", "X"));
  EXPECT_THAT(elements.value().notes, ElementsAre(note));
  const auto of_lammps = read_particles("a.xyz", "4\nAtoms. Timestep: 0\n" + rows);
  EXPECT_THAT(species(of_lammps), ElementsAre("8", "1", "26", "0"));
  EXPECT_TRUE(of_lammps.value().notes.empty());
  const auto types = read_particles("a.xyz", "3\n\n2 0 0 0\n1 1 0 0\n2 3 0 0\n");
  EXPECT_THAT(species(types), ElementsAre("2", "1", "2"));
  const auto named = read_particles("a.xyz", "4\n\n" + rows, {.columns = {"type", "x", "y", "z"}});
  EXPECT_THAT(species(named), ElementsAre("8", "1", "26", "0"));
  for (const std::string row : {"119 0 0 0\n", "Fe 0 0 0\n", "8.5 0 0 0\n", "-1 0 0 0\n"}) {
    EXPECT_EQ(species(read_particles("a.xyz", "2\n\n8 0 0 0\n" + row))[0], "8") << row;
  }
  // All frames go by the first.
  EXPECT_THAT(species(read_particles("a.xyz", "2\n\n6 0 0 0\n8 1 0 0\n1\n\n1 0 0 0\n")),
              ElementsAre("H"));
}

TEST(Xyz, AtomicNumbersHaveNamesInExtendedFiles) {
  for (const std::string name : {"Z", "numbers", "atomic_numbers", "element"}) {
    const auto read =
        read_particles("a.xyz", "2\nProperties=pos:R:3:" + name + ":I:1\n0 0 0 1\n1 0 0 2\n");
    EXPECT_THAT(species(read), ElementsAre("H", "He")) << name;
    EXPECT_TRUE(read.value().notes.empty());
  }
  const auto both = read_particles("a.xyz", "1\nProperties=species:S:1:pos:R:3:Z:I:1\nC 0 0 0 8\n");
  EXPECT_THAT(species(both), ElementsAre("C"));
  EXPECT_NE(find_number_column(both.value(), "Z"), nullptr);
}

TEST(Xyz, PointsNeedNoCount) {
  const std::string note = "it has no count of particles: each of its lines is one";
  for (const std::string text :
       {"# corners\n#\n 0.5 1.5 2.5\n 3 4 -5e0\n", "\n0.5 1.5 2.5\n\n3 4 -5\n",
        "0.5,1.5,2.5\n3,4,-5\n", "x y z\n0.5 1.5 2.5\n3 4 -5",
        "//X Y Z\n0.5\t1.5\t2.5\r\n3\t4\t-5\r\n"}) {
    const auto read = read_particles("a.xyz", text);
    ASSERT_TRUE(read.ok()) << text << format_diagnostic(read.error());
    EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{0.5, 1.5, 2.5}, Vec3d{3, 4, -5})) << text;
    EXPECT_THAT(read.value().notes, ElementsAre(note));
  }
  const auto more = read_particles("a.xyz", "1 2 3 4 5 6\n7 8 9 10 11 12\n");
  ASSERT_TRUE(more.ok()) << format_diagnostic(more.error());
  EXPECT_EQ(find_number_column(more.value(), "radius"), nullptr);  // colours, normals, intensities
  EXPECT_THAT(find_number_column(more.value(), "c4")->values, ElementsAre(4, 10));
  EXPECT_THAT(species(read_particles("a.xyz", "C 0 0 0\nO 1 0 0\n")), ElementsAre("C", "O"));
  const auto named = read_particles("a.xyz", "1 2 3 4\n", {.columns = {"x", "y", "z", "radius"}});
  EXPECT_THAT(find_number_column(named.value(), "radius")->values, ElementsAre(4));
  EXPECT_EQ(particle_error("a.xyz", "0.5 1.5 2.5\n3 4 x\n"),
            "2:5: expected a number, found 'x' (z)");
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
