#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "render/files/particles/select/select_expression.h"
#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of;
using test::spheres_of;
using test::text_column;
using testing::HasSubstr;

ParticleFrame example() {
  ParticleFrame frame = row_of({"Fe", "C", "O", "C", "Fe"});
  for (Vec3d& position : frame.positions) position.y = -position.x;
  frame.numbers = {{"type", {1, 2, 3, 2, 1}},
                   {"c_1[2]", {0.5, -0.5, 1e-3, 2e3, 0}},
                   {"vx", {3, 0, 0, 1, 0}},
                   {"vy", {4, 0, 0, 1, 0}},
                   {"vz", {0, 1, 0, 1, 0}}};
  frame.texts = {text_column("chain", {"A", "A", "B", "B's", "C"}),
                 text_column("resid", {"7", "7", "8", "10", "9"})};
  return frame;
}

/// The places of the particles that are shown: "134".
std::string shown(const std::string& select) {
  EXPECT_EQ(error_of(example(), {.select = select}), "") << select;
  std::string places;
  for (const Sphere& sphere : spheres_of(example(), {.select = select})) {
    places += std::to_string(static_cast<int>(sphere.center.x));
  }
  return places;
}

TEST(Select, ComparesNumbers) {
  EXPECT_EQ(shown(""), "01234");
  EXPECT_EQ(shown("x < 2"), "01");
  EXPECT_EQ(shown("x <= 2"), "012");
  EXPECT_EQ(shown("x == 2"), "2");
  EXPECT_EQ(shown("x != 2"), "0134");
  EXPECT_EQ(shown("x >= 2"), "234");
  EXPECT_EQ(shown("x > 2"), "34");
  EXPECT_EQ(shown("2 < x"), "34");
  EXPECT_EQ(shown("y>-2"), "01");
  EXPECT_EQ(shown("x>+2.5e0"), "34");
  EXPECT_EQ(shown("x > .5"), "1234");
  EXPECT_EQ(shown("type == 1"), "04");
  EXPECT_EQ(shown("type > x"), "012");
  EXPECT_EQ(shown("c_1[2]>=1e-3"), "023");
  EXPECT_EQ(shown("|v| >= 1 \n\t&& |v| < 5"), "13");
  EXPECT_EQ(shown("|v|>4||x==4"), "04");
  EXPECT_EQ(shown("1 == 1"), "01234");
}

TEST(Select, AsksForWhatIsMissing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  ParticleFrame frame = row_of({"Fe", "C", "O", "C"});
  frame.numbers = {{"q", {1, none, 3, none}}};
  frame.texts = {text_column("note", {"a", "", "null", "b"})};
  const auto places = [&](const std::string& select) {
    EXPECT_EQ(error_of(frame, {.select = select}), "") << select;
    std::string found;
    for (const Sphere& sphere : spheres_of(frame, {.select = select})) {
      found += std::to_string(static_cast<int>(sphere.center.x));
    }
    return found;
  };
  EXPECT_EQ(places("q == missing"), "13");
  EXPECT_EQ(places("missing != q && x < 9"), "02");
  EXPECT_EQ(places("q == null || q == 3"), "123");
  EXPECT_EQ(places("!(q == nan)"), "02");
  EXPECT_EQ(places("note == missing"), "12");
  EXPECT_EQ(places("note != missing"), "03");
  EXPECT_EQ(places("x == missing"), "");
  EXPECT_EQ(places("q < 9"), "02");  // what is missing is not less, equal or more
  EXPECT_EQ(places("q != 1"), "123");
  EXPECT_THAT(error_of(frame, {.select = "q > missing"}),
              HasSubstr("what is missing is only asked for by == and != (character 3)"));
  EXPECT_THAT(error_of(frame, {.select = "1 == missing"}),
              HasSubstr("only a column can have missing values (character 3)"));
  EXPECT_THAT(error_of(frame, {.select = "w == missing"}), HasSubstr("there is no column 'w'"));
  frame.numbers.push_back({"missing", {7, 8, 7, 8}});  // a column comes first
  EXPECT_EQ(places("missing == 7"), "02");
}

TEST(Select, ComparesTexts) {
  EXPECT_EQ(shown("species == \"Fe\""), "04");
  EXPECT_EQ(shown("'Fe' != species"), "123");
  EXPECT_EQ(shown("element == 'C'"), "13");
  EXPECT_EQ(shown("species == 'fe'"), "");
  EXPECT_EQ(shown("chain == \"B's\""), "3");
  EXPECT_EQ(shown("chain == ''"), "");
  EXPECT_EQ(shown("chain != 'nobody'"), "01234");
}

TEST(Select, TakesTextsThatAreNumbersAsBoth) {
  EXPECT_EQ(shown("resid < 9"), "012");
  EXPECT_EQ(shown("resid == '10'"), "3");
  ParticleFrame frame = row_of({"1", "2", "1"});
  frame.species->name = "type";
  EXPECT_EQ(spheres_of(frame, {.select = "type == 1"}).size(), 2U);
  EXPECT_EQ(spheres_of(frame, {.select = "type == '1'"}).size(), 2U);
}

TEST(Select, TakesNumbersInQuotesToo) {
  EXPECT_EQ(shown("type == \"1\""), "04");
  EXPECT_EQ(shown("'2' != type"), "024");
  EXPECT_EQ(shown("c_1[2] == '1e-3'"), "2");
  EXPECT_EQ(shown("|v| == '5'"), "0");
}

TEST(Select, JoinsAndNegates) {
  EXPECT_EQ(shown("x > 0 && x < 3"), "12");
  EXPECT_EQ(shown("x < 1 || x > 3"), "04");
  EXPECT_EQ(shown("x == 0 || x > 1 && x < 3"), "02");
  EXPECT_EQ(shown("(x == 0 || x > 1) && x < 3"), "02");
  EXPECT_EQ(shown("(x == 0 || x > 2) && x < 3"), "0");
  EXPECT_EQ(shown("!(x == 2)"), "0134");
  EXPECT_EQ(shown("!!(x == 2)"), "2");
  EXPECT_EQ(shown("!(!(x == 2) && x > 0)"), "02");
  EXPECT_EQ(shown("x < 4 && !(type == 2 || species == 'O') && x < 10"), "0");
  EXPECT_EQ(shown(std::string(100, '(') + "x == 2" + std::string(100, ')')), "2");
}

TEST(Select, NoneIsNoError) {
  EXPECT_EQ(shown("x > 100"), "");
  EXPECT_THAT(notes_of(example(), {.select = "x > 100"}),
              HasSubstr("none of 5 particles meets the selection"));
  const ParticleChoices series;
  EXPECT_THAT(notes_of(example(), {.chosen = &series, .select = "x > 100"}),
              HasSubstr("in some frames no particle meets the selection"));
  const auto made = ParticleSpheres::make(example(), {.select = "x > 100"});
  EXPECT_EQ(made.value().size(), 0U);
  EXPECT_EQ(made.value().center_bounds()[0], made.value().center_bounds()[1]);
}

TEST(Select, RefusesWhatIsWrongWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {" ", "expected a column, a number or a text in quotes, found the end (character 2)"},
      {"x", "expected a comparison (< <= == != >= >), found the end (character 2)"},
      {"x >", "expected a column, a number or a text in quotes, found the end (character 4)"},
      {"> 1", "expected a column, a number or a text in quotes, found '>' (character 1)"},
      {"x = 1", "found '=', expected == (character 3)"},
      {"x == 1 & y == 2", "found '&', expected && (character 8)"},
      {"x == 1 | y == 2", "found '|', expected || (character 8)"},
      {"x == 1 y == 2", "expected && or ||, found 'y' (character 8)"},
      {"x == 1 and y == 2", "expected && or ||, found 'and' (character 8)"},
      {"0 < x < 2", "comparisons do not chain, join two of them with && (character 7)"},
      {"(0 < x < 2)", "comparisons do not chain, join two of them with && (character 8)"},
      {"x == 1 &&",
       "expected a column, a number or a text in quotes, found the end (character 10)"},
      {"(x == 1", "this parenthesis is not closed (character 1)"},
      {"x == 1)", "expected && or ||, found ')' (character 7)"},
      {"(x == 1 2)", "expected && or || or ), found '2' (character 9)"},
      {"()", "expected a column, a number or a text in quotes, found ')' (character 2)"},
      {"(x) == 1", "expected a comparison (< <= == != >= >), found ')' (character 3)"},
      {"!x == 1", "expected ( after !, found 'x' (character 2)"},
      {"x + 1 > 2", "found '+' (character 3)"},
      {"x > 1,5", "found ',' (character 6)"},
      {"x > 3a", "'3a' is no number (character 5)"},
      {"x > 1e999", "'1e999' is no number (character 5)"},
      {"x > 1.2.3", "'1.2.3' is no number (character 5)"},
      {"chain == \"A", "this quotation mark is not closed (character 10)"},
      {"chain < 'A'", "texts are only compared by == and != (character 7)"},
      {"chain == 1", "the column 'chain' is of texts, compare it with one in quotes (character 1)"},
      {"vx == 'A'", "the column 'vx' is of numbers, compare it with one (character 1)"},
      {"vx < '1'", "texts are only compared by == and != (character 4)"},
      {"'A' == 'A'", "a text can only be compared with a column (character 5)"},
      {"1 == 'A'", "a text can only be compared with a column (character 3)"},
      {"species == Fe", "there is no column 'Fe'; species stand in quotes (character 12)"},
      {"typ == 1", "there is no column 'typ'; did you mean 'type'? (character 1)"},
      {"tipe == 'C'", "there is no column 'tipe'; did you mean 'type'? (character 1)"},
      {"|w| > 1", "there are no columns of numbers 'wx', 'wy' and 'wz' (character 1)"},
      {"|v > 1", "found '|', expected || (character 1)"},
      {"x \u2265 1", "found '\u2265' (character 3)"},
  };
  for (const auto& [select, message] : wrong) {
    EXPECT_EQ(error_of(example(), {.select = select}), "select: " + std::string(message)) << select;
  }
  EXPECT_EQ(error_of(example(), {.select = std::string(100000, '(') + "x == 2"}),
            "select: the parentheses are nested too deeply (character 101)");
}

// Whatever is written, it is understood or refused at a place that it has.
TEST(Select, TakesAnyText) {
  const char* const pieces[] = {"x", "type", "species", "|v|", "1",  "-2.5e3", "'C'", "\"", "(",
                                ")", "!",    "!(",      "&&",  "||", "==",     "<",   ">=", "=",
                                "&", "|",    " ",       "1e",  ".",  "chain",  "\n",  "$",  "\xc3"};
  std::uint32_t state = 1;
  int understood = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string select;
    for (int k = 0; k < 1 + i % 12; ++k) {
      state = state * 1664525U + 1013904223U;
      select += pieces[(state >> 8) % std::size(pieces)];
    }
    const auto read = parse_select(select, "select");
    if (read) {
      ++understood;
      EXPECT_GE(read.value().depth(), 1U);
      continue;
    }
    const std::string& message = read.error().message;
    const std::size_t place = message.rfind("(character ");
    ASSERT_NE(place, std::string::npos) << select;
    EXPECT_LE(std::stoul(message.substr(place + 11)), select.size() + 1) << select;
  }
  EXPECT_GT(understood, 20);
}

TEST(Select, ManyComparisonsNeedLittleRoom) {
  std::string select = "x == 0";
  for (int i = 1; i < 10000; ++i) select += " || x == " + std::to_string(i);
  EXPECT_EQ(shown(select), "01234");
  EXPECT_EQ(parse_select(select, "").value().depth(), 2U);
}

TEST(Select, ColumnsOfAStyle) {
  using testing::ElementsAre;
  EXPECT_THAT(columns_of({}), ElementsAre("blue", "color", "diameter", "green", "radius", "red"));
  EXPECT_THAT(columns_of({.radius = 1.0, .color = SpeciesColors{}}), ElementsAre());
  EXPECT_THAT(columns_of({.radius = RadiusColumn{"r"},
                          .color = MappedColors{.by = "|v|"},
                          .select = "(type == 1) && 'A' != chain || r > 0"}),
              ElementsAre("chain", "r", "type", "v_x", "v_y", "v_z", "vx", "vy", "vz"));
  EXPECT_THAT(columns_of({.radius = RadiusTable::vdw, .color = ColorColumns{{"a", "b", "c"}}}),
              ElementsAre("a", "b", "c"));
  EXPECT_THAT(columns_of({.radius = 1.0, .color = ColorColumns{{"a b c"}}}),
              ElementsAre("a", "a b c", "b", "c"));
  EXPECT_THAT(columns_of({.radius = 1.0, .color = SrgbColor{}, .select = "a b"}), ElementsAre());
}

}  // namespace
}  // namespace boule
