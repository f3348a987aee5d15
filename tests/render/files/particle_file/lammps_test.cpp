#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particle_file/read_text.h"

// Dumps and data files of LAMMPS.

namespace boule::lammps {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

std::vector<double> xs(const ParticleFrame& frame) {
  std::vector<double> found;
  for (const Vec3d& p : frame.positions) found.push_back(p.x);
  return found;
}

const std::string dump_head =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 10\n-5 5\n0 4\n";

TEST(Dump, SortsByIdAndTypesAreSpecies) {
  const auto read = read_particles(
      "melt.dump", dump_head + "ITEM: ATOMS id type x y z radius\n7 2 1 2 3 0.5\n3 1 4 5 6 0.25\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  EXPECT_THAT(xs(frame), ElementsAre(4, 1));
  EXPECT_THAT(numbers(frame, "id"), ElementsAre(3, 7));
  EXPECT_THAT(numbers(frame, "type"), ElementsAre(1, 2));
  EXPECT_THAT(numbers(frame, "radius"), ElementsAre(0.25, 0.5));
  ASSERT_TRUE(frame.species.has_value());
  EXPECT_EQ(frame.species->texts[frame.species->indices[0]], "1");
  ASSERT_TRUE(frame.cell.has_value());
  EXPECT_EQ(frame.cell->origin.y, -5);
  EXPECT_EQ(frame.cell->b.y, 10);
  EXPECT_THAT(frame.cell->periodic, ElementsAre(true, false, true));
}

TEST(Dump, NumbersOfElementsAreAtomicNumbers) {
  const auto read = read_particles(
      "melt.dump", dump_head + "ITEM: ATOMS id element x y z\n1 26 1 2 3\n2 8 4 5 6\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(read.value().species->texts, ElementsAre("Fe", "O"));
}

TEST(Data, HasABoxOfAnyEdges) {
  const std::string rows = "\nAtoms # atomic\n\n1 1 0 0 0\n2 1 2.2 2.2 2.2\n";
  const std::string edges = "4.0 0.5 0.0 avec\n-1 4.0 0.5 bvec\n0.5 0.0 4.0 cvec\n";
  const auto read =
      read_particles("a.data", "title\n\n2 atoms\n" + edges + "1 2 3 abc origin\n" + rows);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_TRUE(read.value().cell.has_value());
  EXPECT_EQ(read.value().cell->a, (Vec3d{4, 0.5, 0}));
  EXPECT_EQ(read.value().cell->b, (Vec3d{-1, 4, 0.5}));
  EXPECT_EQ(read.value().cell->c, (Vec3d{0.5, 0, 4}));
  EXPECT_EQ(read.value().cell->origin, (Vec3d{1, 2, 3}));
  EXPECT_THAT(read.value().cell->periodic, ElementsAre(true, true, true));
  EXPECT_TRUE(read.value().notes.empty());
  const auto some = read_particles("a.data", "title\n\n2 atoms\n3 0 1 bvec\n" + rows);
  ASSERT_TRUE(some.ok()) << format_diagnostic(some.error());
  EXPECT_EQ(some.value().cell->a, (Vec3d{1, 0, 0}));
  EXPECT_EQ(some.value().cell->b, (Vec3d{3, 0, 1}));
  EXPECT_THAT(some.value().notes, ElementsAre("it has no line avec, taken as 1 along x",
                                              "it has no line cvec, taken as 1 along z"));
}

TEST(Dump, ScalesFractionsOfTheBox) {
  const auto upright =
      read_particles("d.dump", dump_head + "ITEM: ATOMS xs ys z\n0.5 0.25 3\n0 1 2\n");
  ASSERT_TRUE(upright.ok()) << format_diagnostic(upright.error());
  EXPECT_EQ(upright.value().positions[0].x, 5);
  EXPECT_EQ(upright.value().positions[0].y, -2.5);
  EXPECT_EQ(upright.value().positions[0].z, 3);
  // The box is 4 x 2 x 2 from the origin on, its bounding box is longer by the tilts.
  const auto tilted =
      read_particles("d.dump",
                     "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n-1 6 2\n"
                     "0 2.5 -1\n0 2 0.5\nITEM: ATOMS xsu ysu zsu\n0.5 0.5 0.5\n");
  ASSERT_TRUE(tilted.ok()) << format_diagnostic(tilted.error());
  EXPECT_EQ(tilted.value().cell->origin.x, 0);
  EXPECT_EQ(tilted.value().cell->a.x, 4);
  EXPECT_EQ(tilted.value().cell->b.y, 2);
  EXPECT_EQ(tilted.value().positions[0].x, 2 + 1 - 0.5);
  EXPECT_EQ(tilted.value().positions[0].y, 1 + 0.25);
}

TEST(Dump, ReadsGeneralBoxes) {
  const auto read =
      read_particles("d.dump",
                     "ITEM: BOX BOUNDS abc origin pp pp ff\n1 2 3 10\n4 5 6 11\n7 8 9 12\n"
                     "ITEM: ATOMS x y z\n0 0 0\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().cell->b.z, 6);
  EXPECT_EQ(read.value().cell->origin.y, 11);
  EXPECT_FALSE(read.value().cell->periodic[2]);
}

TEST(Dump, SectionsStandInAnyOrder) {
  const std::string frames =
      "ITEM: UNITS\nnano\nITEM: TIME\n0.5\nITEM: ATOMS element xu yu zu\nFe 1 2 3\n"
      "ITEM: OTHER\nskipped\nITEM: BOX BOUNDS\n0 1\n0 1\n0 1\nITEM: NUMBER OF ATOMS\n1\n"
      "ITEM: TIME\n1.5\nITEM: ATOMS element xu yu zu\nC 4 5 6\nN 5 6 7\n";
  const auto first = read_particles("run.lammpstrj", frames, {}, 0);
  ASSERT_TRUE(first.ok()) << format_diagnostic(first.error());
  EXPECT_EQ(first.value().time, 0.5);
  EXPECT_EQ(first.value().length_in_angstrom, 10);
  EXPECT_TRUE(first.value().cell.has_value());
  EXPECT_THAT(first.value().species->texts, ElementsAre("Fe"));
  const auto last = read_particles("run.lammpstrj", frames, {}, 1);
  ASSERT_TRUE(last.ok()) << format_diagnostic(last.error());
  EXPECT_EQ(last.value().time, 1.5);
  EXPECT_THAT(xs(last.value()), ElementsAre(4, 5));
}

TEST(Dump, KeepsWantedColumnsOnly) {
  ParticleFileOptions options;
  options.wanted = std::vector<std::string>{"q"};
  const auto read = read_particles(
      "d.dump", dump_head + "ITEM: ATOMS id type x y z q c_1\n2 1 0 0 0 5 nan\n1 1 0 0 0 6 nan\n",
      options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().numbers.size(), 1U);
  EXPECT_THAT(numbers(read.value(), "q"), ElementsAre(6, 5));
  EXPECT_THAT(read.value().unread, ElementsAre("id", "type", "c_1"));
}

const std::string data_head =
    "LAMMPS data, units = real\n\n2 atoms\n2 atom types\n\n0 10 xlo xhi\n0 8 ylo yhi\n-1 1 zlo "
    "zhi\n1 2 3 xy xz yz\n\n";

TEST(LammpsData, ReadsStyles) {
  struct Style {
    const char* name;
    const char* before;  ///< columns between the id and the position
  };
  for (const Style& style :
       {Style{"atomic", "2"}, Style{"charge", "2 0.5"}, Style{"molecular", "9 2"},
        Style{"full", "9 2 0.5"}, Style{"sphere", "2 0.5 1000.5"}}) {
    for (const std::string& images : {std::string(), std::string(" 0 -1 2")}) {
      for (const std::string& told : {std::string(), std::string(" # ") + style.name}) {
        const std::string row = std::string(" ") + style.before + " 1 2 3" + images + " # note\n";
        const auto read =
            read_particles("data.any", data_head + "Atoms" + told + "\n\n2" + row + "1" + row);
        ASSERT_TRUE(read.ok()) << style.name << format_diagnostic(read.error());
        EXPECT_THAT(xs(read.value()), ElementsAre(1, 1)) << style.name;
        EXPECT_THAT(numbers(read.value(), "id"), ElementsAre(1, 2)) << style.name;
        EXPECT_THAT(numbers(read.value(), "type"), ElementsAre(2, 2)) << style.name;
        EXPECT_EQ(read.value().notes.size(), told.empty() ? 1U : 0U);
      }
    }
  }
}

TEST(LammpsData, ReadsMassesVelocitiesAndTheCell) {
  const auto read =
      read_particles("a.data", data_head +
                                   "Masses\n# type mass\n1 12.011 # C\n2 15.999 # O water\n\nAtoms "
                                   "# atomic\n\n2 1 1 0 0\n1 2 "
                                   "2 0 0\n\nVelocities\n\n2 4 5 6\n1 7 8 9\n\nBonds\n\n1 1 1 2\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  EXPECT_THAT(xs(frame), ElementsAre(2, 1));
  EXPECT_THAT(numbers(frame, "vx"), ElementsAre(7, 4));
  ASSERT_TRUE(frame.species.has_value());
  EXPECT_EQ(frame.species->texts[frame.species->indices[0]], "O");
  EXPECT_EQ(frame.cell->c.x, 2);
  EXPECT_EQ(frame.cell->c.y, 3);
  EXPECT_EQ(frame.cell->c.z, 2);
  EXPECT_EQ(frame.cell->origin.z, -1);
}

// As read_data takes it (docs.lammps.org/read_data.html).
TEST(LammpsData, BoxLineMayBeMissing) {
  std::string text = data_head + "Atoms # atomic\n\n1 1 0 0 0\n2 1 0 0 0\n";
  text.erase(text.find("0 10 xlo xhi\n"), 13);
  const auto read = read_particles("a.data", text);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().cell->a, (Vec3d{1, 0, 0}));
  EXPECT_EQ(read.value().cell->origin, (Vec3d{-0.5, 0, -1}));
  EXPECT_THAT(read.value().notes, ElementsAre("it has no line xlo xhi, taken as -0.5 0.5"));
}

TEST(LammpsData, ABoxMayBeFlat) {
  std::string text = data_head + "Atoms # atomic\n\n1 1 0 0 0\n2 1 0 0 0\n";
  text.replace(text.find("-1 1 zlo"), 4, "2 2");
  const auto read = read_particles("a.data", text);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().cell->c.z, 0);
  EXPECT_EQ(read.value().cell->origin.z, 2);
}

TEST(LammpsData, RefusesUnknownStylesUnlessColumnsAreNamed) {
  const std::string text = data_head + "Atoms # peri\n\n1 1 5 5 1 2 3\n2 1 5 5 4 5 6\n";
  EXPECT_THAT(particle_error("a.lmp", text), HasSubstr("'peri', is unknown; name the columns"));
  ParticleFileOptions options;
  options.columns = {"id", "type", "volume", "density", "x", "y", "z"};
  const auto read = read_particles("a.lmp", text, options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(numbers(read.value(), "volume"), ElementsAre(5, 5));
  const auto with_images = read_particles(
      "a.lmp", data_head + "Atoms # peri\n\n1 1 5 5 1 2 3 0 0 -1\n2 1 6 5 4 5 6 0 1 0\n", options);
  ASSERT_TRUE(with_images.ok()) << format_diagnostic(with_images.error());
  EXPECT_THAT(numbers(with_images.value(), "volume"), ElementsAre(5, 6));
}

}  // namespace
}  // namespace boule::lammps
