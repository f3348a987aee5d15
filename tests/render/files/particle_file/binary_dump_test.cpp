#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "tests/render/files/particle_file/read_text.h"

// Binary dumps of LAMMPS. What it writes is written here, number by number, as its
// src/dump_atom.cpp and src/dump_custom.cpp do.

namespace boule::binary_dump {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

/// A frame as LAMMPS has it.
struct Frame {
  std::string format = "DUMPCUSTOM";  ///< empty: the old header, which tells neither it nor names
  std::int32_t order = 1, revision = 2;
  std::int64_t step = 100, atoms = 3;
  std::int32_t kind = 0, width = 5, chunks = 2;
  std::vector<std::int32_t> boundary{0, 0, 1, 1, 0, 0};
  std::vector<double> box{0, 10, -5, 5, 0, 4};
  std::string units = "real", columns = "id type x y z ";
  bool has_time = true;
  double time = 0.25;
  std::vector<std::vector<double>> rows{{7, 2, 1, 2, 3, 9, 1, 4, 5, 6}, {3, 1, 7, 8, 9}};
  bool is_swapped = false;

  std::string bytes() const {
    std::string text;
    if (!format.empty()) {
      put(text, -static_cast<std::int64_t>(format.size()));
      text += format;
      put(text, order);
      put(text, revision);
    }
    put(text, step);
    put(text, atoms);
    put(text, kind);
    for (const std::int32_t side : boundary) put(text, side);
    for (const double bound : box) put(text, bound);
    put(text, width);
    if (!format.empty() && revision > 1) {
      put_text(text, units);
      text += static_cast<char>(has_time);
      if (has_time) put(text, time);
      put_text(text, columns);
    }
    put(text, chunks);
    for (const auto& chunk : rows) {
      put(text, static_cast<std::int32_t>(chunk.size()));
      for (const double number : chunk) put(text, number);
    }
    return text;
  }

 private:
  template <class T>
  void put(std::string& text, T number) const {
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
    if (is_swapped) std::reverse(bytes.begin(), bytes.end());
    text += bytes;
  }
  void put_text(std::string& text, const std::string& added) const {
    put(text, static_cast<std::int32_t>(added.size()));
    text += added;
  }
};

Frame old_frame() {
  Frame frame;
  frame.format.clear();
  frame.rows = {{7, 2, 0.5, 0.25, 0, 9, 1, 1, 1, 1}, {3, 1, 0, 0, 0.5}};
  return frame;
}

Result<ParticleFrame> read(const Frame& frame, const ParticleFileOptions& options = {}) {
  return read_particles("run.bin", frame.bytes(), options);
}

std::string error(const Frame& frame, const ParticleFileOptions& options = {}) {
  return particle_error("run.bin", frame.bytes(), options);
}

TEST(BinaryDump, ReadsAllThatItsHeadTells) {
  for (const bool is_swapped : {false, true}) {
    Frame written;
    written.is_swapped = is_swapped;
    const auto found = read(written);
    ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
    const ParticleFrame& frame = found.value();
    EXPECT_THAT(frame.positions, ElementsAre(Vec3d{7, 8, 9}, Vec3d{1, 2, 3}, Vec3d{4, 5, 6}));
    EXPECT_THAT(numbers(frame, "id"), ElementsAre(3, 7, 9));
    EXPECT_THAT(frame.species->texts, ElementsAre("1", "2"));
    EXPECT_EQ(frame.time, 0.25);
    EXPECT_EQ(frame.cell->origin, (Vec3d{0, -5, 0}));
    EXPECT_EQ(frame.cell->b, (Vec3d{0, 10, 0}));
    EXPECT_THAT(frame.cell->periodic, ElementsAre(true, false, true));
    EXPECT_EQ(frame.length_in_angstrom, 1);
    EXPECT_TRUE(frame.notes.empty());
  }
}

TEST(BinaryDump, OldHeadHasColumnsOfAtomStyle) {
  for (const bool is_swapped : {false, true}) {
    for (const char* format : {"", "DUMPATOM"}) {
      Frame written = old_frame();
      written.is_swapped = is_swapped;
      written.format = format;
      written.revision = 1;
      const auto found = read(written);
      ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
      EXPECT_THAT(found.value().positions,
                  ElementsAre(Vec3d{0, -5, 2}, Vec3d{5, -2.5, 0}, Vec3d{10, 5, 4}));
      EXPECT_THAT(
          found.value().notes,
          ElementsAre(HasSubstr("it does not name its columns, taken as id type xs ys zs")));
    }
  }
  Frame with_images = old_frame();
  with_images.width = 8;
  with_images.atoms = 1;
  with_images.rows = {{1, 1, 0, 0, 0, 1, -2, 3}, {}};
  const auto found = read(with_images);
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  EXPECT_THAT(numbers(found.value(), "iy"), ElementsAre(-2));
}

TEST(BinaryDump, OldHeadTakesNamesOfUsers) {
  Frame written = old_frame();
  written.rows = {{1, 2, 3, 26, -1, 4, 5, 6, 8, -2}, {7, 8, 9, 26, -3}};
  EXPECT_THAT(error(written), HasSubstr("particle 1: it is far from the box"));
  const auto found = read(written, {.columns = {"x", "y", "z", "element", "q"}});
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  EXPECT_THAT(found.value().species->texts, ElementsAre("Fe", "O"));
  EXPECT_THAT(numbers(found.value(), "q"), ElementsAre(-1, -2, -3));
  EXPECT_TRUE(found.value().notes.empty());
  EXPECT_THAT(error(written, {.columns = {"x", "y", "z"}}),
              HasSubstr("it has 5 columns, there are names for 3 (columns)"));
  written.width = 1;
  written.atoms = 15;
  EXPECT_THAT(error(written), HasSubstr("it does not name its 1 columns"));
}

TEST(BinaryDump, ReadsTiltedAndGeneralBoxes) {
  Frame tilted;
  tilted.kind = 1;
  tilted.box = {-1, 6, 0, 2.5, 0, 2, 2, -1, 0.5};
  tilted.columns = "id type xsu ysu zsu";
  tilted.atoms = 1;
  tilted.rows = {{}, {1, 1, 0.5, 0.5, 0.5}};
  const auto found = read(tilted);
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  EXPECT_EQ(found.value().cell->a, (Vec3d{4, 0, 0}));
  EXPECT_EQ(found.value().cell->c, (Vec3d{-1, 0.5, 2}));
  EXPECT_THAT(found.value().positions, ElementsAre(Vec3d{2 + 1 - 0.5, 1 + 0.25, 1}));
  Frame general;
  general.kind = 2;
  general.box = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const auto read_general = read(general);
  ASSERT_TRUE(read_general.ok()) << format_diagnostic(read_general.error());
  EXPECT_EQ(read_general.value().cell->b, (Vec3d{4, 5, 6}));
  EXPECT_EQ(read_general.value().cell->origin, (Vec3d{10, 11, 12}));
}

TEST(BinaryDump, ElementsAreTypes) {
  Frame written;
  written.columns = "id element x y z";
  const auto found = read(written);
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  EXPECT_THAT(found.value().species->texts, ElementsAre("1", "2"));
}

TEST(BinaryDump, FramesAreReadByTheirNumbers) {
  Frame first, second;
  first.units = "nano";
  second.units.clear();
  second.time = 0.5;
  second.rows = {{}, {1, 1, 0, 0, 0, 2, 1, 1, 1, 1, 3, 1, 2, 2, 2}};
  const std::string both = first.bytes() + second.bytes();
  for (const long frame : {0L, 1L, -1L}) {
    const auto found = read_particles("dump.melt.bin", both, {}, frame);
    ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
    EXPECT_EQ(found.value().time, frame == 0 ? 0.25 : 0.5);
    EXPECT_EQ(found.value().length_in_angstrom, 10);
    EXPECT_EQ(found.value().positions[0].x, frame == 0 ? 7 : 0);
  }
}

TEST(BinaryDump, FramesBeforeACutAreRead) {
  const std::string one = Frame().bytes(), both = one + one;
  for (std::size_t size = 1; size < both.size(); ++size) {
    const auto found = read_particles("run.bin", both.substr(0, size));
    EXPECT_EQ(found.ok(), size >= one.size()) << size;
    if (!found) {
      EXPECT_THAT(format_diagnostic(found.error()), HasSubstr("the file ends in the "));
    } else if (size > one.size()) {
      EXPECT_THAT(found.value().notes,
                  ElementsAre(HasSubstr("the file is cut off in frame 1 (LAMMPS dump, byte ")));
    }
  }
}

/// What is broken, but not cut off, is no end of the file.
TEST(BinaryDump, DamageBetweenFramesIsAnError) {
  const std::string one = Frame().bytes();
  std::string three = one + one + one;
  for (std::size_t byte = one.size() + 16; byte < one.size() + 24; ++byte) three[byte] = '\x7f';
  const auto found = read_particles("run.bin", three, {}, 0);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(format_diagnostic(found.error()), Not(HasSubstr("the file ends in")));
}

TEST(BinaryDump, ManyRowsAreReadInPieces) {
  Frame written;
  written.atoms = 200000;
  written.rows = {{}, {}};
  for (int i = 0; i < 200000; ++i) {
    auto& chunk = written.rows[i < 150000 ? 0 : 1];
    chunk.insert(chunk.end(), {200000.0 - i, 1, 0.5 * i, 1, 2});
  }
  const auto found = read(written);
  ASSERT_TRUE(found.ok()) << format_diagnostic(found.error());
  for (std::size_t i = 0; i < 200000; ++i) {
    ASSERT_EQ(found.value().positions[i].x, 0.5 * (199999.0 - static_cast<double>(i)));
  }
}

struct Wrong {
  const char* name;
  void (*spoil)(Frame& frame);
  const char* error;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class WrongBinaryDump : public testing::TestWithParam<Wrong> {};

TEST_P(WrongBinaryDump, IsRefusedWithItsPlace) {
  Frame frame;
  GetParam().spoil(frame);
  const std::string found = particle_error("run.bin", frame.bytes(), {.format = "dump"});
  EXPECT_THAT(found, HasSubstr(GetParam().error));
}

INSTANTIATE_TEST_SUITE_P(
    Heads, WrongBinaryDump,
    testing::Values(
        Wrong{"Format", [](Frame& f) { f.format = "DUMPGRID"; },
              "byte 8: expected DUMPATOM or DUMPCUSTOM, found 'DUMPGRID'"},
        Wrong{"Marker", [](Frame& f) { f.format.clear(), f.step = -100; },
              "byte 0: expected a time step, found -100"},
        Wrong{"Order", [](Frame& f) { f.order = 1 << 24; },
              "byte 18: its order of bytes is unknown, expected 1, found 16777216"},
        Wrong{"Revision", [](Frame& f) { f.revision = 3; },
              "byte 22: its revision is unknown, expected 1 or 2, found 3"},
        Wrong{"Step", [](Frame& f) { f.step = -1; }, "byte 26: the time step is below 0"},
        Wrong{"Negative", [](Frame& f) { f.atoms = -3; }, "byte 34: it has -3 particles"},
        Wrong{"TooFew", [](Frame& f) { f.atoms = 2; },
              "its processes have 3 particles, its head promises 2"},
        Wrong{"TooMany", [](Frame& f) { f.atoms = 1000000000000; },
              "its processes have 3 particles, its head promises 1000000000000"},
        Wrong{"Kind", [](Frame& f) { f.kind = 3; },
              "byte 42: expected a box of kind 0, 1 or 2, found 3 (BOX BOUNDS)"},
        Wrong{"Boundary", [](Frame& f) { f.boundary[2] = 4; },
              "byte 54: expected a boundary from 0 to 3, found 4 (BOX BOUNDS)"},
        Wrong{"BoxReversed", [](Frame& f) { f.box[3] = -6; },
              "the box has a negative length along y (BOX BOUNDS)"},
        Wrong{"BoxOfNan", [](Frame& f) { f.box[3] = std::numeric_limits<double>::quiet_NaN(); },
              "the box is larger than the largest number (BOX BOUNDS)"},
        Wrong{"NoColumns", [](Frame& f) { f.width = 0; },
              "byte 118: expected 1 to 4096 columns, found 0"},
        Wrong{"ManyColumns", [](Frame& f) { f.width = 1 << 30; },
              "byte 118: expected 1 to 4096 columns, found 1073741824"},
        Wrong{"Units", [](Frame& f) { f.units = "parsec"; },
              "byte 126: expected units such as lj or real, found 'parsec' (UNITS)"},
        Wrong{"Time", [](Frame& f) { f.time = std::numeric_limits<double>::infinity(); },
              "byte 131: expected a finite time (TIME)"},
        Wrong{"Names", [](Frame& f) { f.columns = "id x y z"; },
              "byte 143: it names 4 columns, it has 5"},
        Wrong{"NoProcesses", [](Frame& f) { f.chunks = 0; }, "it is of 0 processes"},
        Wrong{"ManyProcesses", [](Frame& f) { f.chunks = 1 << 30; },
              "the file ends in the particles of a frame"},
        Wrong{"HalfARow", [](Frame& f) { f.rows[1].pop_back(); },
              "a process has 4 numbers, expected some for each of 5 columns"}),
    [](const auto& test) { return std::string(test.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Rows, WrongBinaryDump,
    testing::Values(Wrong{"IdTwice", [](Frame& f) { f.rows[1][0] = 7; },
                          "particle 3: the id 7 is that of particle 1 too (id)"},
                    Wrong{"IdIsAFraction", [](Frame& f) { f.rows[1][0] = 7.5; },
                          "particle 3: the id 7.5 is no whole number (id)"},
                    Wrong{"PositionOfNan",
                          [](Frame& f) { f.rows[0][7] = std::numeric_limits<double>::quiet_NaN(); },
                          "particle 2 is at no finite position"},
                    Wrong{"InfiniteType",
                          [](Frame& f) { f.rows[0][1] = std::numeric_limits<double>::infinity(); },
                          "of particle 1: expected a finite number (type)"},
                    Wrong{"NoPosition", [](Frame& f) { f.columns = "id type vx y z"; },
                          "there is no column of positions for x"},
                    Wrong{"TwoPositions", [](Frame& f) { f.columns = "id x x y z"; },
                          "more than one column has the position x"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace boule::binary_dump
