#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/render/files/particle_file/broken_file.h"
#include "tests/render/files/particle_file/read_text.h"

namespace boule::table {
namespace {

using test::BrokenFile;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

TEST(Table, SeparatorsAreFoundInTheFirstLines) {
  for (const std::string between : {",", ";", "\t", " ", " , ", "   ", " \t "}) {
    std::string text;
    const std::vector<std::vector<std::string>> rows{{"X", "y", "Z", "R", "name", "VX"},
                                                     {"1", "2", "3", ".5", "a", "7"},
                                                     {"-4", "5e3", "+6", "1", "b", "8"}};
    for (const auto& row : rows) {
      for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : between) + row[i];
      text += "\r\n";
    }
    const auto read = read_particles("a.txt", text);
    ASSERT_TRUE(read.ok()) << between << format_diagnostic(read.error());
    const ParticleFrame& frame = read.value();
    EXPECT_THAT(frame.positions, ElementsAre(Vec3d{1, 2, 3}, Vec3d{-4, 5000, 6})) << between;
    EXPECT_THAT(numbers(frame, "radius"), ElementsAre(0.5, 1));
    EXPECT_THAT(numbers(frame, "vx"), ElementsAre(7, 8));
    ASSERT_NE(find_text_column(frame, "name"), nullptr);
    EXPECT_THAT(find_text_column(frame, "name")->texts, ElementsAre("a", "b"));
  }
}

std::vector<std::string> texts(const ParticleFrame& frame, const std::string& name) {
  const TextColumn* const column = find_text_column(frame, name);
  std::vector<std::string> values;
  if (column == nullptr) return values;
  for (const std::uint32_t index : column->indices) values.push_back(column->texts[index]);
  return values;
}

TEST(Table, EachTabEndsAColumn) {
  // As pandas writes it: the numbers of the rows have no name.
  const auto unnamed = read_particles("a.tsv", "\tx\ty\tz\tv mag\n0\t4\t2\t1\t5\n1\t3\t2\t1\t6\n");
  ASSERT_TRUE(unnamed.ok()) << format_diagnostic(unnamed.error());
  EXPECT_THAT(unnamed.value().positions, ElementsAre(Vec3d{4, 2, 1}, Vec3d{3, 2, 1}));
  EXPECT_THAT(numbers(unnamed.value(), "v mag"), ElementsAre(5, 6));
  const auto empty = read_particles(
      "a.tsv", "x\ty\tz\tname\tq\n0\t1\t2\tbig one\t5\n1\t1\t1\t\t6\n2\t1\t1\tc\t7\n");
  ASSERT_TRUE(empty.ok()) << format_diagnostic(empty.error());
  EXPECT_THAT(texts(empty.value(), "name"), ElementsAre("big one", "", "c"));
  EXPECT_THAT(numbers(empty.value(), "q"), ElementsAre(5, 6, 7));
  // A column without any text, as pandas writes one of missing numbers.
  const auto missing = read_particles("a.tsv", "\tx\ty\tz\tq\n0\t4\t2\t1\t\n1\t3\t2\t1\t\n");
  ASSERT_TRUE(missing.ok()) << format_diagnostic(missing.error());
  EXPECT_THAT(missing.value().positions, ElementsAre(Vec3d{4, 2, 1}, Vec3d{3, 2, 1}));
  EXPECT_THAT(numbers(missing.value(), "q"), ElementsAre(testing::IsNan(), testing::IsNan()));
}

TEST(Table, TabsBehindTheLastColumnMakeNone) {
  for (const std::string text : {"x\ty\tz\tname\n0\t1\t2\tbig one\t\n1\t1\t1\tb\n",
                                 "x\ty\tz\tname\t\n0\t1\t2\tbig one\t\n1\t1\t1\tb\t\t \r\n"}) {
    const auto read = read_particles("a.tsv", text);
    ASSERT_TRUE(read.ok()) << text << format_diagnostic(read.error());
    EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{0, 1, 2}, Vec3d{1, 1, 1})) << text;
    EXPECT_THAT(texts(read.value(), "name"), ElementsAre("big one", "b")) << text;
  }
}

TEST(Table, TabsMayAlignColumns) {
  for (const std::string text :
       {"x\t\ty\tz\t\tq\n4\t\t2\t1\t\t5\n3\t\t2\t1\t\t6\n",    // the same tabs in each line
        "x\t\ty\tz\tq\n4.000000000\t2\t1\t5\n3\t\t2\t1\t6\n",  // fewer behind a long text
        "\tx\ty\tz\tq\n\t4\t2\t1\t5\n\t3\t2\t1\t6\n", "x\ty\tz\tq\t\n4\t2\t1\t5\t\n3\t2\t1\t6\t\n",
        "# x y z q\n4\t2\t1\t5\n3\t2\t1\t6\n", "#\tx\ty\tz\tq\n\t4\t2\t1\t5\n\t3\t2\t1\t6\n"}) {
    const auto read = read_particles("a.tsv", text);
    ASSERT_TRUE(read.ok()) << text << format_diagnostic(read.error());
    EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{4, 2, 1}, Vec3d{3, 2, 1})) << text;
    EXPECT_THAT(numbers(read.value(), "q"), ElementsAre(5, 6)) << text;
  }
}

TEST(Table, IdsMayBeTextsAndOccurTwice) {
  const auto read = read_particles("a.csv", "id,x,y,z\nA7,1,2,3\nA7,4,5,6\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(texts(read.value(), "id"), ElementsAre("A7", "A7"));
  EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{1, 2, 3}, Vec3d{4, 5, 6}));
}

TEST(Table, WithoutNamesThereAreTheUsualOnes) {
  const auto read = read_particles("a.csv", "1,2,3,4,5\n6,7,8,9,10\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().positions[1], (Vec3d{6, 7, 8}));
  EXPECT_THAT(numbers(read.value(), "radius"), ElementsAre(4, 9));
  EXPECT_THAT(numbers(read.value(), "c5"), ElementsAre(5, 10));
  const auto atoms = read_particles("a.txt", "Fe 1 2 3\nC 4 5 6\n");
  ASSERT_TRUE(atoms.ok()) << format_diagnostic(atoms.error());
  EXPECT_EQ(atoms.value().positions[1], (Vec3d{4, 5, 6}));
  EXPECT_THAT(atoms.value().species->texts, ElementsAre("Fe", "C"));
  const auto given = read_particles("a.csv", "1,2,3,4\n", {.columns = {"type", "z", "y", "x"}});
  ASSERT_TRUE(given.ok()) << format_diagnostic(given.error());
  EXPECT_EQ(given.value().positions[0], (Vec3d{4, 3, 2}));
  EXPECT_THAT(given.value().species->texts, ElementsAre("1"));
}

TEST(Table, CommentsNameColumnsAndAreSkipped) {
  for (const std::string header : {"# x y z q", "#x,y,z,q", "// X Y Z q", "# note\n\n#  x y z q"}) {
    const auto read = read_particles(
        "a.txt", header + "\n1 2 3 4 # first\n\n  # between\n//\n5 6 7 8\n \t\n#end\n");
    ASSERT_TRUE(read.ok()) << header << format_diagnostic(read.error());
    EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{1, 2, 3}, Vec3d{5, 6, 7})) << header;
    EXPECT_THAT(numbers(read.value(), "q"), ElementsAre(4, 8)) << header;
  }
  const auto other = read_particles("a.txt", "# made by hand\n1 2 3 4\n");
  ASSERT_TRUE(other.ok());
  EXPECT_THAT(numbers(other.value(), "radius"), ElementsAre(4));
}

TEST(Table, QuotesHoldSeparators) {
  const auto read = read_particles(
      "a.csv",
      "\"\",\"x\",\"y\",\"z\",\"Element\",\"note\",color\n\"1\",1,2,\"3\",\"Fe\",\"a, b\",#ff0000\n"
      "\"2\", 4 ,5,6, \"C\" ,\"\",\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  EXPECT_THAT(frame.positions, ElementsAre(Vec3d{1, 2, 3}, Vec3d{4, 5, 6}));
  EXPECT_THAT(frame.species->texts, ElementsAre("Fe", "C"));
  ASSERT_EQ(frame.texts.size(), 2U);
  EXPECT_THAT(frame.texts[0].texts, ElementsAre("a, b", ""));
  EXPECT_THAT(frame.texts[1].texts, ElementsAre("#ff0000", ""));
  EXPECT_TRUE(frame.numbers.empty());
}

TEST(Table, ColumnsOfParaview) {
  const auto read =
      read_particles("a.csv", "\"Points:0\",\"Points:1\",\"Points:2\",\"diameter\"\n1,2,3,4\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().positions[0], (Vec3d{1, 2, 3}));
}

TEST(Table, NumbersMayHaveDecimalCommas) {
  for (const std::string text :
       {"x;y;z;q;name\n1,5;-2,5e1;3;0,25;a\n0,0;,5;1,0;;b\n",
        "x\ty\tz\tq\tname\n1,5\t-2,5e1\t3\t0,25\ta\n0,0\t,5\t1,0\tNA\tb\n",
        "x y z q name\n1,5 -2,5e1 3 0,25 5\n0,0 ,5 1,0 null 6\n",
        "# x y z q name\n1,5;-2,5e1;3;0,25;\"a\"\n\"0,0\";,5;1,0;--;b\n"}) {
    const auto read = read_particles("a.txt", text);
    ASSERT_TRUE(read.ok()) << text << format_diagnostic(read.error());
    EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{1.5, -25, 3}, Vec3d{0, 0.5, 1})) << text;
    EXPECT_THAT(numbers(read.value(), "q"), ElementsAre(0.25, testing::IsNan())) << text;
    EXPECT_THAT(read.value().notes, ElementsAre("its numbers have decimal commas"));
  }
  const auto plain = read_particles("a.csv", "1,5;2,5;3,5;0,5\n0;1;2;3\n");
  ASSERT_TRUE(plain.ok()) << format_diagnostic(plain.error());
  EXPECT_THAT(numbers(plain.value(), "radius"), ElementsAre(0.5, 3));
  EXPECT_THAT(test::particle_error("a.csv", "x;y;z\n1,5;2,5;3.5\n"),
              HasSubstr("2:1: expected a number, found '1,5' (x)"));
  std::string late = "x;y;z\n";
  for (int i = 0; i < 20; ++i) late += "1,5;2,5;3\n";
  EXPECT_THAT(test::particle_error("a.csv", late + "1;2;3.5\n"),
              HasSubstr("22:5: expected a number with a decimal comma, found '3.5' (z)"));
}

TEST(Table, OtherTextFormatsAreKnownByContent) {
  const auto read = read_particles("a.txt", "1\ncomment\nFe 1 2 3\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(read.value().species->texts, ElementsAre("Fe"));
}

TEST(Table, LongTablesAreReadInPieces) {
  constexpr std::size_t n = 150000;
  std::string text = "x,y,z,name\n";
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 1000 == 7) text += "\n# a comment\n";
    text += std::to_string(i) + ",0.5,-1,n" + std::to_string(i % 3) + "\n";
  }
  const auto read = read_particles("a.csv", text);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().size(), n);
  const TextColumn& names = read.value().texts[0];
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(read.value().positions[i].x, static_cast<double>(i));
    ASSERT_EQ(names.indices[i], i % 3);
  }
  // The error's line counts blank lines and comments too: 300 of them, and the header.
  EXPECT_THAT(test::particle_error("a.csv", text + "1,2,three,n0\n"),
              HasSubstr("150302:5: expected a number, found 'three' (z)"));
}

std::vector<BrokenFile> broken_values() {
  return {
      {"Empty", "", "it holds no rows"},
      {"OnlyComments", "# x y z\n\n", "it holds no rows"},
      {"OnlyNames", "x,y,z\n", "1:1: no rows follow the line that names the columns"},
      {"NoZ", "x,y,w\n1,2,3\n",
       "1:0: there is no column of positions for z; 'columns' can name it (z)"},
      {"TwoX", "x,X,y,z\n1,1,2,3\n2,\n", "3:3: the row ends before this column"},
      {"TwoNames", "x,y,z,q,q\n1,2,3,4,5\n", "1:0: two columns have the name 'q' (q)"},
      {"TwoPositions", "x,y,z,Points:0\n1,2,3,4\n1,2\n", "3:4: the row ends before this column"},
      {"TextPosition", "x,y,z\n1,2,up\n", "2:5: expected a number, found 'up' (z)"},
      {"EmptyPosition", "x,y,z\n1,,3\n", "2:3: expected a number, found '' (y)"},
      {"Nan", "x,y,z\n1,2,3\n1,nan,3\n", "3:3: expected a finite number, found 'nan' (y)"},
      {"Infinite", "x y z\n1 2 -inf\n", "2:5: expected a finite number, found '-inf' (z)"},
      {"BeyondDouble", "x y z\n1 2 1e999\n", "expected a finite number, found '1e999' (z)"},
      {"NulByte", std::string("x,y,z\n1,2,\0\n", 12), "2:5: expected a number, found '\\x00' (z)"},
      {"Hexadecimal", "x y z\n0x1p3 2 3\n", "2:1: expected a number, found '0x1p3' (x)"},
      {"TypesMixed", "x,y,z,q\n1,2,3,4\n1,2,3,four\n", "3:7: expected a number, found 'four' (q)"},
      {"TooManyColumns", std::string(10000, ','), "1:1: it has more than 4096 columns"},
      {"LongLine", "x y z\n1 2 " + std::string(10000000, '3') + "\n",
       "2:5: expected a finite number, found '3333"},
      {"TooFewGiven",
       "1 2 3\n",
       "0:0: names 2 columns, the file has 3 (columns)",
       {.columns = {"x", "y"}}},
      {"GivenTwice",
       "1 2 3 4\n",
       "0:0: two columns have the name 'x' (columns)",
       {.columns = {"x", "y", "z", "x"}}},
      {"GivenWithoutY",
       "1 2 3\n",
       "0:0: there is no column of positions for y; 'columns' can name it (columns)",
       {.columns = {"x", "-", "z"}}},
      {"OneNumber", "1\n", "1:1: no rows follow"},
  };
}

std::vector<BrokenFile> broken_rows() {
  return {
      {"ShortRow", "1 2 3\n4 5\n", "2:4: the row ends before this column, expected 3 columns (z)"},
      {"LongRow", "1 2 3\n4 5 6 7\n", "2:7: the row goes on with '7', expected 3 columns ()"},
      {"LongRowOfCommas",
       "1,2,3\n4,5,6\n7,8,9\n1,2,3\n4,5,6\n7,8,9\n1,2,3\n4,5,6\n7,8,9\n1,2,3\n"
       "4,5,6,7\n",
       "11:7: the row goes on with '7', expected 3 columns"},
      {"CommaBehindTheRow", "x,y,z\n1,2,3\n1,2,3,\n",
       "3:7: the row goes on with an empty column, expected 3 columns"},
      {"LongRowOfTabs", "x\ty\tz\n1\t2\t3\n1\t2\t3\t \t4\n1\t2\t3\n1\t2\t3\n1\t2\t3\n",
       "3:9: the row goes on with '4', expected 3 columns"},
      {"EmptyNumberBetweenTabs", "x\ty\tz\tn\n1\t2\t3\ta\n1\t\t3\tb\n",
       "3:3: expected a number, found '' (y)"},
      {"BlankBetweenTabs", "x\ty\tz\n1\t2\t3\n1 2\t3\t4\n", "3:3: expected a tab, found '2' (y)"},
      {"NamesOfTwo", "x,y\n1,2\n",
       "1:0: there is no column of positions for z; 'columns' can name it (z)"},
      {"OtherSeparator",
       "x,y,z\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n"
       "1;2;3\n",
       "11:1: expected a number, found '1;2;3' (x)"},
      {"BlankInNumber", "x,y,z\n1 2,3,4\n", "2:3: expected ',', found '2' (y)"},
      {"QuoteWithoutEnd", "x,y,z,n\n1,2,3,a\n1,2,3,b\n1,\"2,3,4\n",
       "4:3: expected a number, found '2,3,4' (y)"},
      {"AfterQuote", "x,y,z,n\n1,2,3,\"a\" b\n", "2:11: the row goes on with 'b'"},
  };
}

class BrokenTable : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenTable, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "csv"); }

INSTANTIATE_TEST_SUITE_P(Values, BrokenTable, testing::ValuesIn(broken_values()),
                         test::broken_name);
INSTANTIATE_TEST_SUITE_P(Rows, BrokenTable, testing::ValuesIn(broken_rows()), test::broken_name);

}  // namespace
}  // namespace boule::table
