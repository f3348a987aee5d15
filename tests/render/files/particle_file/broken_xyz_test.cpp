#include <string>
#include <vector>

#include "tests/render/files/particle_file/broken_file.h"

namespace boule::broken_xyz {
namespace {

using test::BrokenFile;

/// An extended XYZ frame of one particle with this second line and this row.
std::string frame(const std::string& comment, const std::string& row) {
  return "1\n" + comment + "\n" + row + "\n";
}

const std::string two = "2\n\nH 1 2 3\nO 4 5 6\n";

std::vector<BrokenFile> broken_rows() {
  return {
      {"Empty", "", "it holds no frames"},
      {"Blank", " \n\t\n", "it holds no frames"},
      {"NoCount", "H 1 2\n", "1:1: expected a count of particles, found 'H 1 2' (count)"},
      {"NegativeCount", "-1\n\n", "1:1: expected a count of particles, found '-1' (count)"},
      {"CountBeyond64Bits", "99999999999999999999\n\n", "1:1: expected a count of particles"},
      {"FractionalCount", "1.5\n\nH 1 2 3\n", "1:1: expected a count of particles, found '1.5'"},
      {"TooMuchPromised", "1000000000000\n\nH 1 2 3\n",
       "1:1: it promises 1000000000000 particles, the file ends after 1 (count)"},
      {"NoComment", "1\n", "1:1: it promises 1 particles, the file ends after 0 (count)"},
      {"CutOff", "2\n\nH 1 2 3\n", "1:1: it promises 2 particles, the file ends after 1 (count)"},
      {"NoCountBehindAFrame", two + "H 1 2 3\n",
       "5:1: expected a count of particles, found 'H 1 2 3' (count)"},
      {"Tinker", "  2  water\n  1  O  0.0 0.1 0.2  1  2\n  2  H  1.0 0.1 0.2  2  1\n",
       "1:1: it is of Tinker, whose .xyz files are not read; Open Babel makes a .xyz of it"},
      {"TinkerWithABox", "1\n 18.6 18.6 18.6 90.0 90.0 90.0\n 1 OW 0.0 0.1 0.2 1\n",
       "1:1: it is of Tinker"},
      {"CountTooSmall", "1\n\nH 1 2 3\nO 4 5 6\n",
       "4:1: expected a count of particles, found 'O 4 5 6' (count)"},
      {"CountTooLarge", "2\n\nH 1 2 3\n1\n\nO 4 5 6\n",
       "6:1: expected a count of particles, found 'O 4 5 6'"},
      {"ShortRow", "2\n\nH 1 2 3\nO 4 5\n",
       "4:6: the row ends before this column, expected 4 columns (z)"},
      {"LongRow", "2\n\nH 1 2 3\nO 4 5 6 7\n",
       "4:9: the row goes on with '7', expected 4 columns ()"},
      {"NoNumber", "1\n\nH 1 2,5 3\n", "3:5: expected a number, found '2,5' (y)"},
      {"Nan", "2\n\nH 1 2 3\nH 1 nan 3\n", "4:5: expected a finite number, found 'nan' (y)"},
      {"Infinite", "1\n\nH 1 2 -Infinity\n", "3:7: expected a finite number"},
      {"BeyondDouble", "1\n\nH 1e400 2 3\n", "3:3: expected a finite number, found '1e400' (x)"},
      {"Hexadecimal", "1\n\nH 0x10 2 3\n", "3:3: expected a number, found '0x10' (x)"},
      {"NulByte", std::string("1\n\nH 1 \0 3\n", 11), "3:5: expected a number, found '\\x00' (y)"},
      {"OnlyTwoNumbers", "1\n\nH 1 2\n", "3:1: expected a number, found 'H' (x)"},
      {"LongLine",
       {"1\n\nH 1 2 ", 10000, std::string(1000, '7'), "x\n"},
       "3:7: expected a number, found '7777"},
      {"LongLineOfWords",
       {"1\n\nH 1 2 3", 2500000, " 4.5", "\n"},
       "3:0: it has more than 4096 columns"},
  };
}

std::vector<BrokenFile> broken_comments() {
  const std::string position = "Properties=species:S:1:pos:R:3";
  return {
      {"UnknownType", frame("Properties=species:S:1:pos:Q:3", "H 1 2 3"),
       "2:24: expected NAME:TYPE:COUNT of the types R, I, S and L, found 'pos:Q' (Properties)"},
      {"CountOfZero", frame("Properties=species:S:1:pos:R:0", "H 1 2 3"),
       "2:24: expected a count of columns from 1 to 1000, found '0' (Properties)"},
      {"PropertyCutOff", frame("Properties=species:S:1:pos", "H 1 2 3"),
       "2:24: expected NAME:TYPE:COUNT of the types R, I, S and L, found 'pos:' (Properties)"},
      {"NoNames", frame("Properties=", "H 1 2 3"), "2:12: it names no columns (Properties)"},
      {"TooManyProperties",
       frame(position + ":a:R:1000:b:R:1000:c:R:1000:d:R:1000:e:R:1000", "H 1 2 3"),
       "2:68: it has more than 4096 columns (Properties)"},
      {"QuoteWithoutEnd", frame("Lattice=\"1 0 0 0 1 0 0 0 1", "H 1 2 3"),
       "2:10: the line ends before the value does (Lattice)"},
      {"LatticeOfEight", frame("Lattice=\"1 0 0 0 1 0 0 0\"", "H 1 2 3"),
       "2:10: expected 9 numbers, found 8 (Lattice)"},
      {"LatticeOfWords", frame("Lattice=\"1 0 0 0 one 0 0 0 1\"", "H 1 2 3"),
       "2:18: expected a finite number, found 'one' (Lattice)"},
      {"InfiniteLattice", frame("Lattice=\"1 0 0 0 inf 0 0 0 1\"", "H 1 2 3"),
       "2:18: expected a finite number, found 'inf' (Lattice)"},
      {"OriginOfTwo", frame("Lattice=\"1 0 0 0 1 0 0 0 1\" Origin=\"0 0\"", "H 1 2 3"),
       "expected 3 numbers, found 2 (Origin)"},
      {"PeriodicMaybe", frame("pbc=\"T F maybe\"", "H 1 2 3"),
       "2:10: expected T or F, found 'maybe' (pbc)"},
      {"NoPositions", frame("Properties=species:S:1:id:I:1", "H 1"),
       "2:0: there is no column of positions for x; 'columns' can name it (x)"},
      {"TwoPositions", frame(position + ":positions:R:3", "H 1 2 3 4 5 6"),
       "2:0: more than one column has the position x (x)"},
      {"NoLogical", frame(position + ":fixed:L:1", "H 1 2 3 yes"),
       "3:9: expected T or F, found 'yes' (fixed)"},
      {"GivenWithoutZ",
       "1\n\nH 1 2\n",
       "2:0: there is no column of positions for z; 'columns' can name it (z)",
       {.columns = {"species", "x", "y"}}},
  };
}

class BrokenXyz : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenXyz, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "xyz"); }

INSTANTIATE_TEST_SUITE_P(Rows, BrokenXyz, testing::ValuesIn(broken_rows()), test::broken_name);
INSTANTIATE_TEST_SUITE_P(Comments, BrokenXyz, testing::ValuesIn(broken_comments()),
                         test::broken_name);

}  // namespace
}  // namespace boule::broken_xyz
