#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/files/particle_file/broken_file.h"
#include "tests/render/files/particle_file/read_text.h"

// Dumps of LAMMPS in YAML, as its src/EXTRA-DUMP/dump_yaml.cpp writes them.

namespace boule::yaml_dump {
namespace {

using test::BrokenFile;
using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

const std::string yaml_head =
    "---\ncreator: LAMMPS\ntimestep: 50\nunits: nano\ntime: 0.25\nnatoms: 2\n"
    "boundary: [ p, p, f, f, p, p, ]\nthermo:\n  - keywords: [ Step, Temp, ]\n  - data: [ 50, 3, "
    "]\n"
    "box:\n  - [ 0, 10 ]\n  - [ -5, 5 ]\n  - [ 0, 4 ]\n";
const std::string yaml_names = "keywords: [ id, element, x, y, z, c_1[2],  ]\ndata:\n";
const std::string yaml_rows = "  - [ 7 , C , 1 , 2 , 3 , 0.5 , ]\n  - [ 3, 'N', 4, 5, 6, nan, ]\n";
const std::string yaml = yaml_head + yaml_names + yaml_rows + "...\n";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  return text.replace(text.find(old), old.size(), replacement);
}

TEST(YamlDump, ReadsWhatLammpsWrites) {
  for (const char* name : {"run.yaml", "run", "dump.melt"}) {
    const auto found = read_particles(name, yaml);
    ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
    const ParticleFrame& frame = found.value();
    EXPECT_THAT(frame.positions, ElementsAre(Vec3d{4, 5, 6}, Vec3d{1, 2, 3}));
    EXPECT_THAT(numbers(frame, "id"), ElementsAre(3, 7));
    EXPECT_THAT(frame.species->texts, ElementsAre("C", "N"));
    EXPECT_THAT(frame.species->indices, ElementsAre(1, 0));
    EXPECT_TRUE(std::isnan(numbers(frame, "c_1[2]").at(0)));
    EXPECT_EQ(numbers(frame, "c_1[2]").at(1), 0.5);
    EXPECT_EQ(frame.time, 0.25);
    EXPECT_EQ(frame.length_in_angstrom, 10);
    EXPECT_EQ(frame.cell->origin, (Vec3d{0, -5, 0}));
    EXPECT_THAT(frame.cell->periodic, ElementsAre(true, false, true));
  }
}

TEST(YamlDump, ReadsTiltedBoxesAndFractions) {
  const auto found = read_particles(
      "run.yaml",
      "creator: LAMMPS\nnatoms: 1\nbox:\n  - [ -1, 6 ]\n  - [ 0, 2.5 ]\n  - [ 0, 2 ]\n"
      "  - [ 2, -1, 0.5 ]\nkeywords: [xs, ys, zs]\ndata:\n- [0.5,0.5,0.5]\n");
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  EXPECT_EQ(found.value().cell->a, (Vec3d{4, 0, 0}));
  EXPECT_THAT(found.value().positions, ElementsAre(Vec3d{2 + 1 - 0.5, 1 + 0.25, 1}));
}

TEST(YamlDump, FramesAreReadByTheirNumbers) {
  const std::string both = yaml + with(with(yaml, "time: 0.25", "time: 0.5"), "units: nano\n", "");
  for (const long frame : {0L, 1L}) {
    const auto found = read_particles("run.yaml", both, {}, frame);
    ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
    EXPECT_EQ(found.value().time, frame == 0 ? 0.25 : 0.5);
    EXPECT_EQ(found.value().length_in_angstrom, 10);
  }
  EXPECT_THAT(particle_error("run.yaml", both + with(yaml, "6, nan", "six, nan")),
              HasSubstr("55:21: expected a number, found 'six' (z)"));
}

TEST(YamlDump, FramesBeforeACutAreRead) {
  const std::string both = yaml + yaml;
  const std::size_t behind_rows = yaml.rfind("...");
  for (std::size_t size = yaml.size(); size < both.size(); ++size) {
    const auto found = read_particles("run.yaml", both.substr(0, size), {}, 0);
    ASSERT_TRUE(found.ok()) << size << format_diagnostic(found.error());
    const std::size_t of_second = size - yaml.size();
    EXPECT_EQ(found.value().notes.empty(), of_second == 0 || of_second + 1 >= behind_rows) << size;
  }
}

class WrongYamlDump : public testing::TestWithParam<BrokenFile> {};

TEST_P(WrongYamlDump, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "yaml"); }

INSTANTIATE_TEST_SUITE_P(
    Heads, WrongYamlDump,
    testing::Values(
        BrokenFile{"Cut", yaml_head, "15:1: the file ends in the head of a frame"},
        BrokenFile{"NoData", yaml_head + "...\n", "15:1: the frame ends here without data"},
        BrokenFile{"NoKey", with(yaml, "timestep: 50", "timestep 50"),
                   "3:1: expected a key and ':', found 'timestep 50'"},
        BrokenFile{"CountIsAWord", with(yaml, "natoms: 2", "natoms: two"),
                   "6:9: expected a count of atoms, found 'two' (natoms)"},
        BrokenFile{"NoCount", with(yaml, "natoms: 2\n", ""),
                   "15:1: the frame has no natoms above (natoms)"},
        BrokenFile{"TooManyPromised", with(yaml, "natoms: 2", "natoms: 1000000000000"),
                   "16:1: natoms promises 1000000000000 rows, the file ends after 3 (natoms)"},
        BrokenFile{"TooFewPromised", with(yaml, "natoms: 2", "natoms: 1"),
                   "18:1: expected the end of the frame, ..., found '  - [ 3, "},
        BrokenFile{
            "Units", with(yaml, "nano", "parsec"),
            "4:8: expected lj, real, metal, si, cgs, electron, micro or nano, found 'parsec'"},
        BrokenFile{"Time", with(yaml, "0.25", "nan"), "5:7: expected a finite number, found 'nan'"},
        BrokenFile{"Boundary", with(yaml, "[ p, p, f", "[ p, f"),
                   "7:1: expected six boundaries, as in [ p, p, f, f, p, p ], found 'boundary: [ "
                   "p, f, f, p"},
        BrokenFile{"BoxOfWords", with(yaml, "-5, 5", "-5, five"),
                   "13:11: expected a finite number, found 'five' (box)"},
        BrokenFile{"BoxReversed", with(yaml, "-5, 5", "5, -5"),
                   "13:1: the box has a negative length along y"},
        BrokenFile{"BoxOfTwoLines", with(yaml, "  - [ 0, 4 ]\n", ""),
                   "14:1: expected a list of 2 numbers"},
        BrokenFile{"NoNames", yaml_head + "data:\n" + yaml_rows, "15:1: the frame has no keywords"},
        BrokenFile{"EmptyNames", with(yaml, yaml_names, "keywords: [ ]\ndata:\n"),
                   "15:1: expected names of columns"},
        BrokenFile{"NoPosition", with(yaml, "x, y, z", "vx, y, z"),
                   "15:1: there is no column of positions for x"}),
    test::broken_name);

INSTANTIATE_TEST_SUITE_P(
    Rows, WrongYamlDump,
    testing::Values(
        BrokenFile{"ShortRow", with(yaml, "6, nan, ]", "6 ]"),
                   "18:23: the row ends before this column, expected 6 columns (c_1[2])"},
        BrokenFile{"LongRow", with(yaml, "nan, ]", "nan, 7, ]"),
                   "18:29: the row goes on with '7', expected 6 columns"},
        BrokenFile{"NoDash", with(yaml, "  - [ 3", "    [ 3"), "18:5: expected '-', found '['"},
        BrokenFile{"NoBracket", with(yaml, "- [ 3", "- 3"), "18:5: expected '[', found '3'"},
        BrokenFile{"NoEnd", with(yaml, "nan, ]", "nan,"), "18:28: expected ']', found ''"},
        BrokenFile{"NoNumber", with(yaml, "4, 5", "4, five"),
                   "18:18: expected a number, found 'five' (y)"},
        BrokenFile{"NoComma", with(yaml, "4, 5", "4 5"), "18:17: expected ',', found '5'"},
        BrokenFile{"PositionOfNan", with(yaml, "4, 5", "4, nan"),
                   "18:18: expected a finite number, found 'nan' (y)"},
        BrokenFile{"IdTwice", with(yaml, "[ 3", "[ 7"), "18:1: the id 7 is that of line 17 too"}),
    test::broken_name);

}  // namespace
}  // namespace boule::yaml_dump
