#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// Numbers that are missing, infinite, or none.

namespace boule::missing {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

TEST(Missing, WordsOfTablesStandForNoNumber) {
  for (const std::string word :
       {"", "nan", "NaN", "-nan", "null", "NULL", "NA", "N/A", "n/a", "<NA>", "#N/A", "None", "--",
        "-", "\\N", "\"null\"", "\"\"", " null "}) {
    for (const std::string& rows :
         {"1,2,3," + word + ",5\n1,2,3,4,6\n", "1,2,3,4,5\n1,2,3," + word + ",6\n",
          "1,2,3," + word + ",5\n1,2,3," + word + ",6\n1,2,3,4.5,6\n"}) {
      const auto read = read_particles("a.csv", "x,y,z,q,p\n" + rows);
      ASSERT_TRUE(read.ok()) << word << format_diagnostic(read.error());
      EXPECT_THAT(numbers(read.value(), "q"), testing::Contains(IsNan())) << word;
      EXPECT_THAT(numbers(read.value(), "q"), testing::Contains(testing::AnyOf(4, 4.5))) << word;
      EXPECT_THAT(numbers(read.value(), "p")[1], 6) << word;
    }
  }
}

TEST(Missing, ColumnsAtLineEndsMayBeEmpty) {
  for (const std::string separator : {",", ";", "\t"}) {
    std::string text;
    for (const std::string row : {"x|y|z|name|q|r2", "1|2|3|a||", "4|5|6|b|7|", "4|5|6|c||8"}) {
      for (const char c : row) text += c == '|' ? separator : std::string(1, c);
      text += "\r\n";
    }
    const auto read = read_particles("a.csv", text);
    ASSERT_TRUE(read.ok()) << separator << format_diagnostic(read.error());
    EXPECT_THAT(numbers(read.value(), "q"), ElementsAre(IsNan(), 7, IsNan()));
    EXPECT_THAT(numbers(read.value(), "r2"), ElementsAre(IsNan(), IsNan(), 8));
  }
}

TEST(Missing, EmptyColumnsHoldNumbersUntilText) {
  const auto none = read_particles("a.csv", "x,y,z,q\n1,2,3,\n1,2,3,null\n");
  ASSERT_TRUE(none.ok()) << format_diagnostic(none.error());
  EXPECT_THAT(numbers(none.value(), "q"), ElementsAre(IsNan(), IsNan()));
  // The text is behind the rows that are looked at first, and two columns have one.
  std::string text = "x,y,z,name,q,note\n";
  for (int i = 0; i < 3000; ++i) text += "1,2,3,,,NA\n";
  const auto late = read_particles("a.csv", text + "4,5,6,iron,7,hot\n");
  ASSERT_TRUE(late.ok()) << format_diagnostic(late.error());
  ASSERT_NE(find_text_column(late.value(), "name"), nullptr);
  EXPECT_THAT(find_text_column(late.value(), "name")->texts, ElementsAre("", "iron"));
  EXPECT_THAT(find_text_column(late.value(), "note")->texts, ElementsAre("NA", "hot"));
  EXPECT_EQ(numbers(late.value(), "q").back(), 7);
  EXPECT_THAT(numbers(late.value(), "q").front(), IsNan());
}

TEST(Missing, TypesAndPositionsAreNot) {
  const auto types = read_particles("a.csv", "x,y,z,type\n1,2,3,1\n4,5,6,null\n7,8,9,null\n");
  ASSERT_TRUE(types.ok()) << format_diagnostic(types.error());
  EXPECT_THAT(types.value().species->texts, ElementsAre("1", ""));
  EXPECT_THAT(particle_error("a.csv", "x,y,z\n1,null,3\n2,3,4\n"),
              HasSubstr("2:3: expected a number, found 'null' (y)"));
  EXPECT_THAT(particle_error("a.csv", "x,y,z,q\n1,2,3,4\n1,2,3,hot\n"),
              HasSubstr("3:7: expected a number, found 'hot' (q)"));
  EXPECT_THAT(
      particle_error("a.csv", "x,y,z,radius\n1,2,3,4\n1,2,3,null\n", {.positive = "radius"}),
      HasSubstr("3:7: expected a number above 0, found 'null' (radius)"));
}

TEST(Missing, NanIsMissingEverywhereInfinityNowhere) {
  const std::string head = "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y z q\n";
  const std::string two = "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x y z q\n";
  const std::string gro =
      "t\n1\n    1SOL     OW    1   0.230   0.628   1.113     nan  0.1000  0.2000\n1 1 1\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float q\nend_header\n1 2 3 ";
  const auto q = [](const std::string& name, const std::string& bytes, const std::string& column) {
    const auto read = read_particles(name, bytes);
    EXPECT_TRUE(read.ok()) << name << format_diagnostic(read.error());
    return read ? numbers(read.value(), column) : std::vector<double>();
  };
  EXPECT_THAT(q("a.xyz", "1\n\nC 1 2 3 nan\n", "c4"), ElementsAre(IsNan()));
  EXPECT_THAT(q("a.dump", head + "1 1 2 3 NaN\n", "q"), ElementsAre(IsNan()));
  EXPECT_THAT(q("a.gro", gro, "vx"), ElementsAre(IsNan()));
  EXPECT_THAT(q("a.ply", ply + "nan\n", "q"), ElementsAre(IsNan()));
  EXPECT_THAT(particle_error("a.xyz", "1\n\nC 1 2 3 inf\n"),
              HasSubstr("3:9: expected a finite number, found 'inf' (c4)"));
  EXPECT_THAT(particle_error("a.dump", two + "1 1 2 3 4\n2 1 2 3 null\n"),
              HasSubstr("5:9: expected a number, found 'null' (q)"));
  EXPECT_THAT(particle_error("a.ply", ply + "inf\n"), HasSubstr("found 'inf' (q)"));
}

TEST(Missing, LenientReaderKeepsNonFiniteNumbers) {
  const ParticleFileOptions lenient{.lenient = true};
  const auto column = [&](const std::string& name, const std::string& bytes,
                          const std::string& of) {
    const auto read = read_particles(name, bytes, lenient);
    EXPECT_TRUE(read.ok()) << name << format_diagnostic(read.error());
    return read ? column_extent(*find_number_column(read.value(), of)) : ColumnExtent{};
  };
  const ColumnExtent xyz =
      column("a.xyz", "4\n\nC 1 2 3 inf\nC 1 2 3 4\nC 1 2 3 nan\nC 1 2 3 x\n", "c4");
  EXPECT_EQ(xyz.least, 4);
  EXPECT_EQ(xyz.largest, 4);
  EXPECT_EQ(xyz.missing, 2U);
  EXPECT_EQ(xyz.infinite, 1U);
  const auto logical =
      column("a.xyz", "1\nProperties=species:S:1:pos:R:3:f:L:1\nC 1 2 3 maybe\n", "f");
  EXPECT_EQ(logical.missing, 1U);
  EXPECT_GT(logical.least, logical.largest);
  EXPECT_EQ(column("a.csv", "x,y,z,q\n1,2,3,4\n1,2,3,-inf\n", "q").infinite, 1U);
  EXPECT_THAT(particle_error("a.xyz", "1\n\nC 1 inf 3\n", lenient), HasSubstr("found 'inf' (y)"));
  if (!has_gemmi()) return;
  const std::string atom = "ATOM      1  C   MOL     1       3.451   0.685   0.000   inf ***** \n";
  EXPECT_EQ(column("a.pdb", atom, "occupancy").infinite, 1U);
  EXPECT_EQ(column("a.pdb", atom, "bfactor").missing, 1U);
}

}  // namespace
}  // namespace boule::missing
