#include <string>
#include <vector>

#include "tests/render/files/particle_file/broken_file.h"

// Dumps and data files of LAMMPS that are refused.

namespace boule::broken_lammps {
namespace {

using test::BrokenFile;

const std::string step = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\n";
const std::string box = "ITEM: BOX BOUNDS pp pp pp\n0 10\n-5 5\n0 4\n";
const std::string head = step + box;  // 8 lines
const std::string atoms = "ITEM: ATOMS id x y z\n";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  return text.replace(text.find(old), old.size(), replacement);
}

const std::string rows = "1 1 2 3\n2 4 5 6\n", scaled = "ITEM: ATOMS id xs ys zs\n";
const std::string tilted = "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-1 6 2\n0 2.5 -1\n0 2 0.5\n";

std::vector<BrokenFile> broken_frames() {
  return {
      {"Empty", "", "the frame ends here and has no ITEM: ATOMS"},
      {"NoItem", "TIMESTEP\n0\n", "1:1: expected ITEM: and its name, found 'TIMESTEP'"},
      {"NoAtoms", head, "the frame ends here and has no ITEM: ATOMS"},
      {"SecondStepWithoutAtoms", head + head + atoms + rows,
       "9:1: the frame ends here and has no ITEM: ATOMS"},
      {"CountIsAWord", with(head, "\n2\n", "\ntwo\n") + atoms + rows,
       "4:1: expected a count of atoms, found 'two' (NUMBER OF ATOMS)"},
      {"NegativeCount", with(head, "\n2\n", "\n-2\n") + atoms + rows,
       "4:1: expected a count of atoms, found '-2' (NUMBER OF ATOMS)"},
      {"TooMuchPromised", with(head, "\n2\n", "\n1000000000000\n") + atoms + rows,
       "9:1: it needs 1000000000000 lines below, the file ends after 2"},
      {"CutOff", head + atoms + "1 1 2 3\n", "9:1: it needs 2 lines below, the file ends after 1"},
      {"TooManyRows", head + atoms + rows + "3 7 8 9\n",
       "12:1: expected ITEM: and its name, found '3 7 8 9'"},
      {"CountBehindTheAtoms", "ITEM: ATOMS x y z\n1 2 3\nITEM: NUMBER OF ATOMS\n2\n",
       "2:1: it has 1 atoms, NUMBER OF ATOMS says 2 (NUMBER OF ATOMS)"},
      {"BoxCutOff", step + "ITEM: BOX BOUNDS\n0 10\n",
       "5:1: it needs 3 lines below, the file ends after 1"},
      {"BoxOfWords", with(head, "-5 5", "-5 five") + atoms + rows,
       "7:4: expected a finite number, found 'five' (BOX BOUNDS)"},
      {"InfiniteBox", with(head, "-5 5", "-5 inf") + atoms + rows,
       "7:4: expected a finite number, found 'inf' (BOX BOUNDS)"},
      {"BoxOfOneNumber", with(head, "-5 5", "5") + atoms + rows,
       "7:1: expected 2 numbers, found 1 (BOX BOUNDS)"},
      {"BoxBeyondDouble", with(head, "-5 5", "-1e308 1e308") + atoms + rows,
       "6:1: the box is larger than the largest number (BOX BOUNDS)"},
      {"BoxReversed", with(head, "-5 5", "5 -5") + atoms + rows,
       "7:1: the box has a negative length along y (BOX BOUNDS)"},
      {"TiltedBoxReversed", step + with(tilted, "0 2 0.5", "5 -1 1") + atoms + rows,
       "8:1: the box has a negative length along z (BOX BOUNDS)"},
      {"BoundsAreLessThanTheTilt", step + with(tilted, "-1 6 2", "-1 6 9") + atoms + rows,
       "6:1: the box has a negative length along x (BOX BOUNDS)"},
      {"TiltMissing", step + with(tilted, "0 2 0.5", "0 2") + atoms + rows,
       "8:1: expected 3 numbers, found 2 (BOX BOUNDS)"},
      {"UnknownUnits", "ITEM: UNITS\nparsec\n" + head + atoms + rows,
       "2:1: expected lj, real, metal, si, cgs, electron, micro or nano, found 'parsec' (UNITS)"},
      {"TimeIsAWord", "ITEM: TIME\nnow\n" + head + atoms + rows,
       "2:1: expected a finite number, found 'now' (TIME)"},
  };
}

std::vector<BrokenFile> broken_rows() {
  return {
      {"NoColumnNames", head + "ITEM: ATOMS\n" + rows,
       "9:1: it does not name its columns, as in ITEM: ATOMS id type x y z"},
      {"TooManyColumns",
       {head + "ITEM: ATOMS x y z", 2500000, " c_1", "\n" + rows},
       "9:1: it has more than 4096 columns"},
      {"NoZ", head + "ITEM: ATOMS id x y\n1 1 2\n2 3 4\n",
       "9:1: there is no column of positions for z; 'columns' can name it (z)"},
      {"TwoX", head + "ITEM: ATOMS x x y z\n1 1 2 3\n2 4 5 6\n",
       "9:1: more than one column has the position x (x)"},
      {"ShortRow", head + atoms + "1 1 2 3\n2 4 5\n",
       "11:6: the row ends before this column, expected 4 columns (z)"},
      {"LongRow", head + atoms + "1 1 2 3\n2 4 5 6 7\n",
       "11:9: the row goes on with '7', expected 4 columns"},
      {"NoNumber", head + atoms + "1 1 2 3\n2 4 y 6\n", "11:5: expected a number, found 'y' (y)"},
      {"Nan", head + atoms + "1 1 2 nan\n2 4 5 6\n", "10:7: expected a finite number"},
      {"NulByte", head + atoms + std::string("1 1 \0 3\n2 4 5 6\n", 16),
       "10:5: expected a number, found '\\x00' (y)"},
      {"IdTwice", head + atoms + "7 1 2 3\n7 4 5 6\n",
       "11:1: the id 7 is that of line 10 too (id)"},
      {"IdIsAWord", head + atoms + "three 1 2 3\n2 4 5 6\n",
       "10:1: expected a number, found 'three' (id)"},
      {"IdIsAFraction", head + atoms + "1 1 2 3\n3.5 4 5 6\n",
       "11:1: the id 3.5 is no whole number (id)"},
      {"DistantIdTwice",
       with(head, "\n2\n", "\n3\n") + atoms + "7 1 2 3\n1000000007 1 2 3\n7 4 5 6\n",
       "12:1: the id 7 is that of line 10 too (id)"},
      {"FractionsWithoutABox", step + scaled + rows,
       "5:1: its positions are fractions of a box, which it does not have (BOX BOUNDS)"},
      {"SomeFractionsOfATiltedBox", step + tilted + "ITEM: ATOMS id xs y z\n" + rows,
       "9:1: in a tilted box, all of x, y and z must be fractions of it, or none (xs)"},
      {"FractionsBeyondDouble", with(head, "-5 5", "0 1e300") + scaled + "1 1 2 3\n2 4 1e300 6\n",
       "11:1: its position in the box is too large a number"},
      {"LongLine",
       {head + atoms + "1 1 2 3\n2 4 5 ", 10000, std::string(1000, '6'), "x\n"},
       "11:7: expected a number, found '6666"},
      {"TooFewGiven",
       head + atoms + rows,
       "10:7: the row goes on with '3', expected 3 columns",
       {.columns = {"x", "y", "z"}}},
  };
}

class BrokenDump : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenDump, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "dump"); }

INSTANTIATE_TEST_SUITE_P(Frames, BrokenDump, testing::ValuesIn(broken_frames()), test::broken_name);
INSTANTIATE_TEST_SUITE_P(Rows, BrokenDump, testing::ValuesIn(broken_rows()), test::broken_name);

const std::string data_head =
    "title\n\n2 atoms\n2 atom types\n\n0 10 xlo xhi\n0 8 ylo yhi\n"
    "-1 1 zlo zhi\n\n";  // 9 lines

const std::string data_title = "Atoms # atomic\n\n", data_rows = "1 1 1 2 3\n2 2 4 5 6\n";
const std::string masses = "Masses\n\n1 12 # C\n2 16 # O\n\n";
const std::string good_data = data_head + data_title + data_rows;

std::vector<BrokenFile> broken_headers() {
  return {
      {"NoDataAtAll", "# an input of LAMMPS\n\nunits lj\natom_style atomic\nrun 100\n",
       "6:1: it has no line with the count of atoms, \"N atoms\" (atoms)"},
      {"NoAtoms", data_head, "10:1: the file ends without a section Atoms (Atoms)"},
      {"CountIsAWord", with(good_data, "2 atoms", "two atoms"),
       "10:1: the header has no count of atoms (atoms)"},
      {"CountIsMissing", with(good_data, "2 atoms", "atoms"),
       "10:1: the header has no count of atoms (atoms)"},
      {"NegativeCount", with(good_data, "2 atoms", "-2 atoms"),
       "3:1: expected a count before 'atoms' (atoms)"},
      {"CountBeyond64Bits", with(good_data, "2 atoms", "99999999999999999999 atoms"),
       "3:1: expected a count before 'atoms' (atoms)"},
      {"TypesAreAFraction", with(good_data, "2 atom types", "2.5 atom types"),
       "4:1: expected a count before 'atom types' (atom types)"},
      {"TooMuchPromised", with(good_data, "2 atoms", "1000000000000 atoms"),
       "10:1: the header promises 1000000000000 rows, the file ends after 2 (Atoms)"},
      {"TooManyTypesPromised", with(data_head, "2 atom types", "1000000000000 atom types") + masses,
       "10:1: the header promises 1000000000000 rows, the file ends after 3 (Masses)"},
      {"CutOff", data_head + data_title + "1 1 1 2 3\n",
       "10:1: the header promises 2 rows, the file ends after 1 (Atoms)"},
      {"TooManyRows", good_data + "3 1 7 8 9\n",
       "14:1: expected the name of a section, found '3 1 7 8 9'"},
      {"AtomsTwice", good_data + "\n" + data_title + data_rows,
       "15:1: the section is there twice (Atoms)"},
      {"BoxReversed", with(good_data, "0 8 ylo", "8.0 0.0 ylo"),
       "7:1: the box has a negative length along y (ylo)"},
      {"BoxOfWords", with(good_data, "0 8 ylo", "0 eight ylo"),
       "7:3: expected a finite number, found 'eight' (ylo)"},
      {"BoxOfOneNumber", with(good_data, "0 8 ylo", "8 ylo"),
       "7:1: expected 2 numbers before 'ylo' (ylo)"},
      {"BoxOfNan", with(good_data, "0 8 ylo", "0 8,5 ylo"),
       "7:3: expected a finite number, found '8,5' (ylo)"},
      {"BoxBeyondDouble", with(good_data, "0 8 ylo", "-1e308 1e308 ylo"),
       "the box is larger than the largest number"},
      {"EdgeOfTwo", with(good_data, "\n\nAtoms", "\n1 2 avec\n\nAtoms"),
       "9:1: expected 3 numbers before 'avec' (avec)"},
      {"OriginOfWords", with(good_data, "\n\nAtoms", "\n1 2 z abc origin\n\nAtoms"),
       "9:5: expected a finite number, found 'z' (abc)"},
      {"TiltsOfTwo", with(good_data, "\n\nAtoms", "\n1 2 xy xz yz\n\nAtoms"),
       "9:1: expected 3 numbers before 'xy' (xy)"},
  };
}

std::vector<BrokenFile> broken_sections() {
  return {
      {"UnknownStyle", data_head + "Atoms # peri\n\n" + data_rows,
       "12:1: the style of its atoms, 'peri', is unknown; name the columns"},
      {"StyleNotTold", data_head + "Atoms\n\n1 2 3 4\n5 6 7 8\n",
       "12:1: the style of its atoms is not told, as in Atoms # full"},
      {"ShortRow", data_head + data_title + "1 1 1 2 3\n2 2 4 5 # 6\n",
       "13:9: the row ends before this column, expected 5 columns (z)"},
      {"LongRow", data_head + data_title + "1 1 1 2 3\n2 2 4 5 6 7\n",
       "13:11: the row goes on with '7', expected 5 columns"},
      {"NoNumber", data_head + data_title + "1 1 1 2 3\n2 2 4 y 6\n",
       "13:7: expected a number, found 'y' (y)"},
      {"Nan", data_head + data_title + "1 1 1 2 3\n2 2 4 5 nan\n",
       "13:9: expected a finite number"},
      {"NulByte", data_head + data_title + std::string("1 1 1 2 \0\n2 2 4 5 6\n", 20),
       "12:9: expected a number, found '\\x00' (z)"},
      {"IdTwice", data_head + data_title + "2 1 1 2 3\n2 2 4 5 6\n",
       "13:1: the id 2 is that of line 12 too (id)"},
      {"IdIsAWord", data_head + data_title + "three 1 1 2 3\n2 2 4 5 6\n",
       "12:1: expected a number, found 'three' (id)"},
      {"IdIsAFraction", data_head + data_title + "1 1 1 2 3\n2.5 2 4 5 6\n",
       "13:1: the id 2.5 is no whole number (id)"},
      {"LongLine",
       {data_head + data_title + "1 1 1 2 3\n2 2 4 5 ", 10000, std::string(1000, '6'), "x\n"},
       "13:9: expected a number, found '6666"},
      {"NoSuchType", data_head + masses + data_title + "1 1 1 2 3\n2 3 4 5 6\n",
       "17:1: an atom is of no type from 1 to 2 (type)"},
      {"VelocitiesCutOff", good_data + "\nVelocities\n\n1 1 2 3\n",
       "15:1: the header promises 2 rows, the file ends after 1 (Velocities)"},
      {"VelocitiesOfOthers", good_data + "\nVelocities\n\n1 1 2 3\n3 1 2 3\n",
       "17:1: its ids are not those of Atoms (Velocities)"},
      {"VelocitiesTwice", good_data + "\nVelocities\n\n1 1 2 3\n1 1 2 3\n",
       "18:1: the id 1 is that of line 17 too (id)"},
      {"GivenWithoutZ",
       good_data,
       "12:1: there is no column of positions for z; 'columns' can name it (z)",
       {.columns = {"id", "type", "x", "y", "q"}}},
  };
}

class BrokenData : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenData, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "data"); }

INSTANTIATE_TEST_SUITE_P(Headers, BrokenData, testing::ValuesIn(broken_headers()),
                         test::broken_name);
INSTANTIATE_TEST_SUITE_P(Sections, BrokenData, testing::ValuesIn(broken_sections()),
                         test::broken_name);

}  // namespace
}  // namespace boule::broken_lammps
