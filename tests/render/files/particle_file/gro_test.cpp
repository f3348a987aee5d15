#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "render/files/particle_file/frame/element_guess.h"
#include "tests/render/files/particle_file/read_text.h"

// GRO files of GROMACS.

namespace boule::gro {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;

const std::string title = "water in a box, t= 2.50000 step= 7\n";
const std::string oxygen = "    1SOL     OW    1   0.230  -0.628   1.113";
const std::string hydrogen = "    1SOL    HW1    2   0.137   0.626   0.150";
const std::string sodium = "    2NA      NA    3  10.000 -10.000   0.001";
const std::string box = "   1.86206   2.5   3\n";

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

std::vector<std::string> texts(const TextColumn& column) {
  std::vector<std::string> found;
  for (const std::uint32_t index : column.indices) found.push_back(column.texts[index]);
  return found;
}

TEST(Gro, ReadsAFrame) {
  const auto read = read_particles(
      "conf.gro", title + "    3\n" + oxygen + "\n" + hydrogen + "\r\n" + sodium + "  \n" + box);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 3U);
  EXPECT_EQ(frame.positions[0].x, 0.230);
  EXPECT_EQ(frame.positions[0].y, -0.628);
  EXPECT_EQ(frame.positions[0].z, 1.113);
  EXPECT_EQ(frame.positions[2].y, -10);
  EXPECT_EQ(frame.length_in_angstrom, 10);
  EXPECT_EQ(frame.time, 2.5);
  ASSERT_TRUE(frame.species.has_value());
  EXPECT_THAT(texts(*frame.species), ElementsAre("O", "H", "Na"));
  ASSERT_EQ(frame.texts.size(), 2U);
  EXPECT_EQ(frame.texts[0].name, "resname");
  EXPECT_THAT(texts(frame.texts[0]), ElementsAre("SOL", "SOL", "NA"));
  EXPECT_EQ(frame.texts[1].name, "name");
  EXPECT_THAT(texts(frame.texts[1]), ElementsAre("OW", "HW1", "NA"));
  EXPECT_EQ(frame.numbers.size(), 2U);
  EXPECT_THAT(numbers(frame, "resid"), ElementsAre(1, 1, 2));
  EXPECT_THAT(numbers(frame, "id"), ElementsAre(1, 2, 3));
  ASSERT_TRUE(frame.cell.has_value());
  EXPECT_EQ(frame.cell->a.x, 1.86206);
  EXPECT_EQ(frame.cell->b.y, 2.5);
  EXPECT_EQ(frame.cell->c.z, 3);
  EXPECT_THAT(frame.cell->periodic, ElementsAre(true, true, true));
}

TEST(Gro, ReadsVelocitiesAndMoreDigits) {
  const auto right = read_particles(
      "conf.gro",
      "\n2\n12345PROTE-1CA199999-123.45678 -23.45678  -3.45678 -2.345678  0.123456  7.000000\n"
      "   -1ABC   1HB1    0   0.00000   0.00000   0.00000\n1 2 3 4 5 6 7 8 9\n");
  ASSERT_TRUE(right.ok()) << format_diagnostic(right.error());
  const ParticleFrame& frame = right.value();
  EXPECT_EQ(frame.positions[0].x, -123.45678);
  EXPECT_EQ(frame.positions[0].y, -23.45678);
  EXPECT_EQ(frame.positions[0].z, -3.45678);
  EXPECT_THAT(numbers(frame, "resid"), ElementsAre(12345, -1));
  EXPECT_THAT(numbers(frame, "vx"), ElementsAre(-2.345678, 0));
  EXPECT_THAT(numbers(frame, "vz"), ElementsAre(7, 0));
  EXPECT_THAT(texts(*frame.species), ElementsAre("C", "H"));
  EXPECT_FALSE(frame.time.has_value());
  EXPECT_EQ(frame.cell->a.y, 4);
  EXPECT_EQ(frame.cell->a.z, 5);
  EXPECT_EQ(frame.cell->b.x, 6);
  EXPECT_EQ(frame.cell->b.z, 7);
  EXPECT_EQ(frame.cell->c.x, 8);
  EXPECT_EQ(frame.cell->c.y, 9);
  EXPECT_EQ(frame.cell->c.z, 3);
}

TEST(Gro, ReadsFrames) {
  const std::string first = "a t= 1\n1\n" + oxygen + "\n0 0 0\n";
  const std::string second = "\n2\n" + hydrogen + "\n" + sodium + "\n" + box + "\n \n";
  for (const char* name : {"run.gro", "run"}) {
    const auto read = read_particles(name, first + second, {}, 0);
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    EXPECT_EQ(read.value().time, 1);
    EXPECT_FALSE(read.value().cell.has_value());
    const auto last = read_particles(name, first + second);
    ASSERT_TRUE(last.ok()) << format_diagnostic(last.error());
    EXPECT_EQ(last.value().size(), 2U);
    EXPECT_TRUE(last.value().cell.has_value());
  }
}

TEST(Gro, KeepsWantedColumnsOnly) {
  ParticleFileOptions options;
  options.wanted = std::vector<std::string>{"vy", "name"};
  const auto read = read_particles("a.gro",
                                   "\n1\n  abcSOL     OW*****   0.230  -0.628   1.113  1.0000  "
                                   "2.0000  3.0000\n1 1 1\n",
                                   options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().numbers.size(), 1U);
  EXPECT_THAT(numbers(read.value(), "vy"), ElementsAre(2));
  ASSERT_EQ(read.value().texts.size(), 1U);
  EXPECT_EQ(read.value().texts[0].name, "name");
  EXPECT_THAT(read.value().unread,
              testing::UnorderedElementsAre("resid", "id", "resname", "vx", "vz"));
  EXPECT_THAT(read.value().species->texts, ElementsAre("O"));
}

/// A file that is read in several pieces, whose names differ from piece to piece.
TEST(Gro, ReadsPiecesAsOneText) {
  constexpr std::size_t atoms = 60000;
  std::string text = "big\n" + std::to_string(atoms) + "\n";
  for (std::size_t i = 0; i < atoms; ++i) {
    std::array<char, 64> row{};
    std::snprintf(row.data(), row.size(), "%5zu%-5zu%5s%5zu%8.3f%8.3f%8.3f\n", i % 100000, i / 7000,
                  i % 2 == 0 ? "OW" : "HW1", i % 100000, static_cast<double>(i) / 8.0, 0.5, -0.25);
    text += row.data();
  }
  const ParallelFor backwards = [](std::size_t count, const auto& body) {
    for (std::size_t i = count; i > 0; --i) body(i - 1);
  };
  const auto read = read_particles("a.gro", text + box, {}, -1, backwards);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  for (std::size_t i = 0; i < atoms; ++i) {
    ASSERT_NEAR(frame.positions[i].x, static_cast<double>(i) / 8.0, 0.0005);  // three decimals
    ASSERT_EQ(frame.texts[0].texts[frame.texts[0].indices[i]], std::to_string(i / 7000));
    ASSERT_EQ(frame.species->texts[frame.species->indices[i]], i % 2 == 0 ? "O" : "H");
  }
  text[text.size() - 60000] = '?';
  EXPECT_NE(particle_error("a.gro", text + box), "no error");
}

TEST(Gro, GuessesElementsFromNames) {
  EXPECT_EQ(element_of_atom("CA", "ALA"), "C");
  EXPECT_EQ(element_of_atom("CA", "CA"), "Ca");
  EXPECT_EQ(element_of_atom("CA", "CA2+"), "Ca");
  EXPECT_EQ(element_of_atom("1HB2", "ALA"), "H");
  EXPECT_EQ(element_of_atom("OT1", "GLY"), "O");
  EXPECT_EQ(element_of_atom("NA", "HEM"), "N");
  EXPECT_EQ(element_of_atom("NA", "NA+"), "Na");
  EXPECT_EQ(element_of_atom("Cl-", "ION"), "Cl");
  EXPECT_EQ(element_of_atom("CLA", "CLA"), "Cl");
  EXPECT_EQ(element_of_atom("SOD", "SOD"), "Na");
  EXPECT_EQ(element_of_atom("K", "K"), "K");
  EXPECT_EQ(element_of_atom("Fe2", "HEM"), "Fe");
  EXPECT_EQ(element_of_atom("FE", "HEM"), "Fe");
  EXPECT_EQ(element_of_atom("ZN", "CYS"), "Zn");
  EXPECT_EQ(element_of_atom("Cb", "ALA"), "C");
  EXPECT_EQ(element_of_atom("MW", "SOL"), "MW");
  EXPECT_EQ(element_of_atom("LP1", "SOL"), "LP1");
  EXPECT_EQ(element_of_atom("12", "X"), "12");
  EXPECT_EQ(element_of_atom("", ""), "");
}

struct Broken {
  std::string text, error;
};

/// In place of its bytes, which hold addresses.
void PrintTo(const Broken& file, std::ostream* out) { *out << file.error; }

class GroBroken : public testing::TestWithParam<Broken> {};

TEST_P(GroBroken, IsRefused) {
  EXPECT_EQ(particle_error("a.gro", GetParam().text), GetParam().error);
}

std::string with_row(const std::string& row) { return "t\n1\n" + row + "\n1 1 1\n"; }
std::string with_rows(const std::string& row) {
  return "t\n2\n" + oxygen + "\n" + row + "\n1 1 1\n";
}
std::string with_box(const std::string& line) { return "t\n1\n" + oxygen + "\n" + line; }

const std::string no_width = "3:1: expected three positions of the same width from column 21 on ()";

INSTANTIATE_TEST_SUITE_P(
    All, GroBroken,
    testing::Values(
        Broken{"", "0:0: it holds no frames ()"}, Broken{"\n \n", "0:0: it holds no frames ()"},
        Broken{"title", "2:1: expected a count of atoms below the title, found '' (count)"},
        Broken{"t\nabc\n", "2:1: expected a count of atoms below the title, found 'abc' (count)"},
        Broken{"t\n-1\n", "2:1: expected a count of atoms below the title, found '-1' (count)"},
        Broken{"t\n1.5\n", "2:1: expected a count of atoms below the title, found '1.5' (count)"},
        Broken{"t\n1 2\n", "2:1: expected a count of atoms below the title, found '1 2' (count)"},
        Broken{"t\n3\n" + oxygen + "\n1 1 1\n",
               "2:1: it promises 3 atoms and a box, the file ends after 2 lines (count)"},
        Broken{"t\n18446744073709551615\n" + oxygen + "\n1 1 1\n",
               "2:1: it promises 18446744073709551615 atoms and a box, the file ends after 2 lines "
               "(count)"},
        Broken{"t\n1\n" + oxygen,
               "2:1: it promises 1 atoms and a box, the file ends after 1 lines (count)"},
        Broken{"t\n1\n" + oxygen + "\n1 1 1\nmore\nand more\n" + oxygen + "\n",
               "6:1: expected a count of atoms below the title, found 'and more' (count)"},
        Broken{with_row(""), no_width}, Broken{with_row("    1SOL     OW    1   0.230"), no_width},
        Broken{with_row("    1SOL     OW    1       1       2       3"), no_width},
        Broken{with_row("    1SOL     OW    1   0.230   0.62   1.113"), no_width},
        Broken{with_row(std::string(100, ' ') + "0.1 0.2 0.3"), no_width},
        Broken{with_row("  abcSOL     OW    1   0.230   0.628   1.113"),
               "3:3: expected a number, found 'abc' (resid)"},
        Broken{with_row("     SOL     OW    1   0.230   0.628   1.113"),
               "3:1: expected a number in columns 1 to 5, found none (resid)"},
        Broken{with_row("    1SOL     OW*****   0.230   0.628   1.113"),
               "3:16: expected a number, found '*****' (id)"},
        Broken{with_rows("    1SOL     OW    1   0.230   0.x28   1.113"),
               "4:32: expected a number, found '0.x28' (y)"},
        Broken{with_rows("    1SOL     OW    1   0.230     nan   1.113"),
               "4:34: expected a finite number, found 'nan' (y)"},
        Broken{with_rows("    1SOL     OW    1   0.230   0.628   1e999"),
               "4:40: expected a finite number, found '1e999' (z)"},
        Broken{with_rows("    1SOL     OW    1   0.230   0.628"),
               "4:37: expected a number in columns 37 to 44, found none (z)"},
        Broken{with_rows("    1SOL     OW    1"),
               "4:21: expected a number in columns 21 to 28, found none (x)"},
        Broken{with_rows("    1SOL     OW    1  0.230  0.628  1.113  2.000"),
               "4:37: expected a number, found '1.113  2' (z)"},
        Broken{with_rows(hydrogen + "  0.1000"),
               "4:47: the row goes on with '0.1000' behind column 44 ()"},
        Broken{with_row(hydrogen + "  0.1000  0.abc0  0.2000"),
               "3:55: expected a number, found '0.abc0' (vy)"},
        Broken{with_box("\n"), "4:1: expected a box of 3 or 9 numbers, found 0 (box)"},
        Broken{with_box("1 2\n"), "4:1: expected a box of 3 or 9 numbers, found 2 (box)"},
        Broken{with_box("1 2 3 4\n"), "4:1: expected a box of 3 or 9 numbers, found 4 (box)"},
        Broken{with_box("1 b 3\n"), "4:3: expected a finite number, found 'b' (box)"},
        Broken{with_box("1 2 inf\n"), "4:5: expected a finite number, found 'inf' (box)"},
        Broken{with_box(hydrogen), "4:5: expected a finite number, found '1SOL' (box)"}));

}  // namespace
}  // namespace boule::gro
