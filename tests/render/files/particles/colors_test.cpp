#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::colors_of;
using test::error_of;
using test::meaning_of;
using test::notes_of;
using test::row_of;
using test::row_of_particles;
using test::row_with;
using test::spheres_of;
using test::text_column;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Colors, AreTheMaterialsByDefault) {
  EXPECT_THAT(colors_of(row_of_particles(2), {.material = 3000}), ElementsAre("-", "-"));
}

TEST(Colors, AreOneColor) {
  EXPECT_THAT(colors_of(row_of({"C", "H"}), {.color = SrgbColor{1, 2, 3}, .material = 127}),
              ElementsAre("#010203", "#010203"));
}

TEST(Colors, OfWhatIsMissingAreGrey) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const ParticleStyle grey{.color = MappedColors{"q", ColorMap(NamedColorMap::grey), {}}};
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) {
    values.push_back(i);
    values.push_back(none);
  }
  const ParticleFrame frame = row_with("q", values);
  const auto colors = colors_of(frame, grey);
  EXPECT_EQ(colors[0], "#000000");
  EXPECT_EQ(colors[200], "#ffffff");
  for (std::size_t i = 1; i < colors.size(); i += 2) EXPECT_EQ(colors[i], "#a0a0a0");
  // The range is that of the numbers that are there.
  EXPECT_THAT(meaning_of(frame, grey).scale->range, ElementsAre(1, 99));
  EXPECT_EQ(meaning_of(frame, grey).scale->missing, 101U);
  const std::string told = "101 particles have no number in 'q', the colour of that is #a0a0a0";
  EXPECT_THAT(notes_of(frame, grey), HasSubstr(told));
  const ParticleFrame nothing = row_with("q", {none, none});
  EXPECT_THAT(colors_of(nothing, grey), ElementsAre("#a0a0a0", "#a0a0a0"));
  EXPECT_THAT(meaning_of(nothing, grey).scale->range, ElementsAre(0, 1));
  EXPECT_THAT(error_of(row_with("radius", {1, none}), {}),
              HasSubstr("the radius of particle 2 of 2 is nan, expected a finite number above 0"));
}

TEST(Colors, ComeFromElementsAndThePalette) {
  const ParticleFrame frame = row_of({"C", "bead", "H", "1", "bead", "D"});
  const std::vector<std::string> expected{"#909090", "#e69f00", "#ffffff",
                                          "#56b4e9", "#e69f00", "#ffffff"};
  EXPECT_EQ(colors_of(frame), expected);
  EXPECT_EQ(colors_of(frame, {.color = SpeciesColors{}}), expected);
  EXPECT_EQ(colors_of(frame, {.color = ColorColumns{{"species"}}}), expected);
  EXPECT_EQ(colors_of(frame, {.color = ColorColumns{{"element"}}}), expected);
}

TEST(Colors, TellTheSpeciesThatAreShown) {
  const ParticleFrame frame = row_of({"C", "bead", "H", "bead"});
  const auto species = meaning_of(frame, {.radius = 1.0, .select = "species != 'C'"}).species;
  ASSERT_EQ(species.size(), 2U);
  EXPECT_EQ(species[0].name, "bead");
  EXPECT_EQ(hex_text(species[0].color), "#e69f00");
  EXPECT_EQ(species[0].count, 2U);
  EXPECT_EQ(species[1].name, "H");
  EXPECT_EQ(species[1].count, 1U);
}

TEST(Colors, OfSpeciesIgnoreTheSelection) {
  const ParticleFrame frame = row_of({"bead", "wall", "d"});
  EXPECT_THAT(colors_of(frame), ElementsAre("#e69f00", "#56b4e9", "#ffffff"));
  EXPECT_THAT(colors_of(frame, {.select = "x == 1"}), ElementsAre("#56b4e9"));
}

TEST(Colors, OfManySpeciesRepeat) {
  std::vector<std::string> species;
  for (int i = 0; i < 9; ++i) species.push_back(std::to_string(i));
  EXPECT_EQ(colors_of(row_of(species))[8], "#e69f00");
  EXPECT_THAT(notes_of(row_of(species)),
              HasSubstr("the column 'species' has 9 kinds and the palette 8 colours"));
  species.pop_back();
  EXPECT_THAT(notes_of(row_of(species)), Not(HasSubstr("palette")));
}

TEST(Colors, OfTypesGoByTheirNumbers) {
  EXPECT_THAT(colors_of(row_of({"10", "2", "1"})), ElementsAre("#009e73", "#56b4e9", "#e69f00"));
}

TEST(Colors, OfKnownKindsStay) {
  const ParticleFrame frame = row_of({"new", "bead", "C", "wall"});
  ParticleChoices chosen;
  chosen.kinds = {{"C", {0x90, 0x90, 0x90}, 1},
                  {"wall", {0xe6, 0x9f, 0x00}, 1},
                  {"bead", {0x00, 0x9e, 0x73}, 1}};
  EXPECT_THAT(colors_of(frame, {.chosen = &chosen}),
              ElementsAre("#56b4e9", "#009e73", "#909090", "#e69f00"));
}

TEST(Colors, FewWholeNumbersAreKinds) {
  const ParticleStyle style{.radius = 1.0, .color = ColorColumns{{"q"}}};
  EXPECT_THAT(colors_of(row_with("q", {10, 2, 10, -1}), style),
              ElementsAre("#009e73", "#56b4e9", "#009e73", "#e69f00"));
  const auto meaning = meaning_of(row_with("q", {10, 2, 10}), style);
  EXPECT_FALSE(meaning.scale);
  ASSERT_EQ(meaning.species.size(), 2U);
  EXPECT_EQ(meaning.species[1].name, "10");
  EXPECT_EQ(meaning.species[1].count, 2U);
  EXPECT_TRUE(meaning_of(row_with("q", {1, 2.5}), style).scale);
  EXPECT_TRUE(meaning_of(row_with("q", {0, 0}), style).scale);  // at rest
  EXPECT_TRUE(meaning_of(row_with("q", {1, 2, 3, 4, 5, 6, 7, 8, 9}), style).scale);
  // A map is asked for.
  EXPECT_TRUE(meaning_of(row_with("q", {1, 2}), {.radius = 1.0, .color = MappedColors{"q"}}).scale);
}

TEST(Colors, ColumnsOfKindsMayHaveMore) {
  std::vector<double> numbers;
  for (int i = 0; i < 256; ++i) numbers.push_back(i);
  for (const char* name : {"type", "mol", "c_cluster", "MolID"}) {
    const ParticleStyle style{.radius = 1.0, .color = ColorColumns{{name}}};
    EXPECT_EQ(meaning_of(row_with(name, numbers), style).species.size(), 256U) << name;
    EXPECT_THAT(notes_of(row_with(name, numbers), style), HasSubstr("so they repeat"));
  }
  numbers.push_back(256);
  const ParticleStyle by_type{.radius = 1.0, .color = ColorColumns{{"type"}}};
  EXPECT_TRUE(meaning_of(row_with("type", numbers), by_type).scale);
  EXPECT_EQ(meaning_of(row_with("type", {2, 2}), by_type).species.size(), 1U);
}

TEST(Colors, TypesAsSpeciesHaveSpeciesColors) {
  ParticleFrame frame = row_of({"3", "1"});
  frame.species->name = "type";
  frame.numbers = {{"type", {3, 1}}};
  EXPECT_EQ(colors_of(frame, {.color = ColorColumns{{"type"}}}), colors_of(frame));
}

TEST(Colors, AreThoseOfTexts) {
  ParticleFrame frame = row_of({"C", "C"});
  frame.texts = {text_column("color", {"#102030", "#FFffFF"})};
  EXPECT_THAT(colors_of(frame), ElementsAre("#102030", "#ffffff"));
  EXPECT_THAT(colors_of(frame, {.color = ColorColumns{{"color"}}}),
              ElementsAre("#102030", "#ffffff"));
  EXPECT_TRUE(meaning_of(frame).species.empty());
  frame.texts = {text_column("color", {"#102030", "red"})};
  EXPECT_EQ(error_of(frame, {}),
            "color: the colour of particle 2 of 2 is 'red', expected '#rrggbb'");
  EXPECT_EQ(error_of(frame, {.select = "x < 1"}), "");
  frame.texts = {text_column("color", {"blue", "red"})};  // no such colours: species
  EXPECT_THAT(colors_of(frame), ElementsAre("#909090", "#909090"));
}

TEST(Colors, OtherTextsGetThePalette) {
  ParticleFrame frame = row_of({"C", "C", "C"});
  frame.texts = {text_column("chain", {"C", "B", "C"})};
  const ParticleStyle style{.color = ColorColumns{{"chain"}}};
  EXPECT_THAT(colors_of(frame, style), ElementsAre("#e69f00", "#56b4e9", "#e69f00"));
  EXPECT_EQ(meaning_of(frame, style).species.size(), 2U);
}

TEST(Colors, AreThoseOfComponents) {
  ParticleFrame frame = row_of({"C", "C"});
  frame.numbers = {{"red", {0, 1}}, {"green", {0.5, 0.25}}, {"blue", {1, 0.002}}};
  EXPECT_THAT(colors_of(frame), ElementsAre("#0080ff", "#ff4001"));
  EXPECT_THAT(colors_of(frame, {.color = ColorColumns{{"blue", "red", "red"}}}),
              ElementsAre("#ff0000", "#01ffff"));
  frame.numbers[0].values = {0, 256};
  EXPECT_EQ(error_of(frame, {}),
            "color: the colour of particle 2 of 2 is 256, 0.25, 0.002, expected numbers from 0 to "
            "1, or whole numbers to 255");
  frame.numbers[0].values = {-0.001, 0};
  EXPECT_THAT(error_of(frame, {}), HasSubstr("particle 1 of 2 is -0.001, 0.5, 1"));
}

TEST(Colors, ThreeWordsMayNameOneColumn) {
  ParticleFrame frame = row_of_particles(2);
  frame.numbers = {{"red", {0, 1}}, {"green", {0.5, 0.25}}, {"blue", {1, 0}}};
  const ParticleStyle style{.color = ColorColumns{{"red green blue"}}};
  EXPECT_THAT(colors_of(frame, style), ElementsAre("#0080ff", "#ff4000"));
  frame.numbers.push_back({"red green blue", {2.5, 4}});
  ASSERT_TRUE(meaning_of(frame, style).scale.has_value());
  EXPECT_THAT(meaning_of(frame, style).scale->range, ElementsAre(2.5, 4));
  frame.numbers.pop_back();
  frame.texts = {text_column("red green blue", {"#102030", "#ffffff"})};
  EXPECT_THAT(colors_of(frame, style), ElementsAre("#102030", "#ffffff"));
}

TEST(Colors, ANameMayHaveBlanks) {
  const ParticleFrame frame = row_with("Velocity Magnitude", {1.5, 3});
  const ParticleStyle style{.color = ColorColumns{{"Velocity Magnitude"}}};
  EXPECT_THAT(meaning_of(frame, style).scale->range, ElementsAre(1.5, 3));
  EXPECT_EQ(error_of(frame, {.color = ColorColumns{{"Velocity Magnitud"}}}),
            "color: there is no column 'Velocity Magnitud'; did you mean 'Velocity Magnitude'?");
}

TEST(Colors, BadComponentsNameTheirParticle) {
  ParticleFrame frame = row_of_particles(3);
  frame.numbers = {{"red", {255, 1, 0}}, {"green", {0, 0, 0}}, {"blue", {0, 0, 300}}};
  EXPECT_THAT(error_of(frame, {}), HasSubstr("particle 3 of 3 is 0, 0, 300"));
  frame.numbers[2].values = {0, 0.5, 0};  // codes and parts together
  EXPECT_THAT(error_of(frame, {}), HasSubstr("particle 1 of 3 is 255, 0, 0"));
}

TEST(Colors, ComponentsMayBeCodes) {
  ParticleFrame frame = row_of_particles(2);
  frame.numbers = {{"red", {0, 255}}, {"green", {128, 1}}, {"blue", {3, 200}}};
  EXPECT_THAT(colors_of(frame), ElementsAre("#008003", "#ff01c8"));
  EXPECT_THAT(notes_of(frame), HasSubstr("'red', 'green' and 'blue' are taken as codes"));
  frame.numbers[2].values[1] = 200.5;
  EXPECT_THAT(error_of(frame, {}), HasSubstr("particle 2 of 2 is 255, 1, 200.5, expected numbers"));
}

TEST(Colors, AreMapped) {
  const ParticleFrame frame = row_with("q", {-3, -1, 0, 1, 7});
  const MappedColors mapped{.by = "q", .map = ColorMap(NamedColorMap::grey), .range = {{-1, 1}}};
  EXPECT_THAT(colors_of(frame, {.color = mapped}),
              ElementsAre("#000000", "#000000", "#808080", "#ffffff", "#ffffff"));
  const auto scale = meaning_of(frame, {.color = mapped}).scale;
  ASSERT_TRUE(scale.has_value());
  EXPECT_EQ(scale->by, "q");
  EXPECT_THAT(scale->range, ElementsAre(-1, 1));
  EXPECT_EQ(scale->map.color(0.5), (SrgbColor{128, 128, 128}));
  EXPECT_THAT(notes_of(frame, {.color = mapped}), Not(HasSubstr("percentile")));
}

TEST(Colors, AreMappedByPositionsNormsAndTypes) {
  ParticleFrame frame = row_with("v_x", {3, 0, 0.5});
  frame.numbers.push_back({"v_y", {4, 0, 1}});
  frame.numbers.push_back({"v_z", {0, 0, 0}});
  frame.species = text_column("type", {"1", "3", "2"});
  const auto range = [&](const std::string& by) {
    return meaning_of(frame, {.color = MappedColors{.by = by}}).scale->range;
  };
  EXPECT_THAT(range("|v|"), ElementsAre(0, 5));
  EXPECT_THAT(range("x"), ElementsAre(0, 2));
  EXPECT_THAT(range("type"), ElementsAre(1, 3));
  const auto by_column = [&](const std::string& name) {
    return meaning_of(frame, {.color = ColorColumns{{name}}});
  };
  EXPECT_THAT(by_column("|v|").scale->range, ElementsAre(0, 5));
  EXPECT_THAT(by_column("v_x").scale->range, ElementsAre(0, 3));
  EXPECT_EQ(by_column("type").species.size(), 3U);
  EXPECT_FALSE(by_column("type").scale.has_value());
}

TEST(Colors, RangeTakesPercentilesOfShownParticles) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back((i * 8) % 1001 == 0 ? 1e9 : (i * 8) % 1001);
  const ParticleFrame frame = row_with("q", values);  // 1 .. 1000 and 1e9
  const ParticleStyle style{.radius = 1.0, .color = MappedColors{.by = "q"}};
  EXPECT_THAT(meaning_of(frame, style).scale->range, ElementsAre(11, 991));
  EXPECT_THAT(notes_of(frame, style),
              HasSubstr("the colours of 'q' go from 11 to 991, the 1st and 99th percentile"));
  ParticleStyle some = style;
  some.select = "q < 102";  // 1 .. 101
  EXPECT_THAT(meaning_of(frame, some).scale->range, ElementsAre(2, 100));
}

TEST(Colors, PercentilesAreThoseOfSorting) {
  for (const int spread : {1, 20, 300}) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 200000; ++i) {
      const double u = double(i * 2654435761U % 1000003U) / 1000003 - 0.5;
      values.push_back(std::copysign(std::exp(spread * std::fabs(u)), u));
    }
    const ParticleFrame frame = row_with("q", values);
    const auto range =
        meaning_of(frame, {.radius = 1.0, .color = MappedColors{.by = "q"}}).scale->range;
    std::sort(values.begin(), values.end());
    EXPECT_EQ(range[0], values[1999]);
    EXPECT_EQ(range[1], values[198000]);
  }
}

TEST(Colors, SingleValueTakesTheMapsMiddle) {
  const ParticleStyle style{.radius = 1.0,
                            .color = MappedColors{.by = "q", .map = ColorMap(NamedColorMap::grey)}};
  for (const double value : {0.0, -7.0, 1e300, 5e-324}) {
    const ParticleFrame frame = row_with("q", {value, value});
    const auto scale = meaning_of(frame, style).scale;
    EXPECT_LT(scale->range[0], value);
    EXPECT_GT(scale->range[1], value);
    EXPECT_THAT(colors_of(frame, style), ElementsAre("#808080", "#808080")) << value;
    EXPECT_THAT(notes_of(frame, style), HasSubstr("the colours of 'q' are those of one number"));
  }
}

TEST(Colors, LargeNumbersDoNotOverflow) {
  constexpr double most = std::numeric_limits<double>::max();
  const MappedColors mapped{.by = "q", .map = ColorMap(NamedColorMap::grey)};
  EXPECT_THAT(colors_of(row_with("q", {-most, 0, most}), {.color = mapped}),
              ElementsAre("#000000", "#808080", "#ffffff"));
  ParticleFrame frame = row_with("vx", {most, 0, 0});
  frame.numbers.push_back({"vy", {most, 0, 1e-200}});
  frame.numbers.push_back({"vz", {most, 0, 0}});
  const auto scale = meaning_of(frame, {.color = MappedColors{.by = "|v|"}}).scale;
  EXPECT_THAT(scale->range, ElementsAre(0, most));
  EXPECT_EQ(spheres_of(frame, {.select = "|v| > 1e-201"}).size(), 2U);
}

TEST(Colors, RefuseWhatIsWrong) {
  ParticleFrame frame = row_with("speed", {1, 2});
  EXPECT_EQ(error_of(frame, {.color = SpeciesColors{}}), "color: the file tells no species");
  EXPECT_EQ(error_of(frame, {.color = ColorColumns{{"sped"}}}),
            "color: there is no column 'sped'; did you mean 'speed'?");
  EXPECT_EQ(error_of(frame, {.color = ColorColumns{{"x", "y", "sped"}}}),
            "color: there is no column 'sped'; did you mean 'speed'?");
  EXPECT_THAT(error_of(frame, {.color = ColorColumns{{"x", "y"}}}), HasSubstr("found 2"));
  EXPECT_THAT(error_of(frame, {.color = ColorColumns{}}), HasSubstr("found 0"));
  EXPECT_EQ(error_of(frame, {.color = MappedColors{.by = "sped"}}),
            "color.by: there is no column 'sped'; did you mean 'speed'?");
  EXPECT_EQ(error_of(frame, {.color = MappedColors{.by = "|v|"}}),
            "color.by: there are no columns of numbers 'vx', 'vy' and 'vz'");
  EXPECT_EQ(error_of(frame, {.color = MappedColors{.by = "speed", .range = {{1, 1}}}}),
            "color.range: expected two finite numbers, the larger one last");
  EXPECT_EQ(error_of(frame, {.color = SrgbColor{}, .material = 128}),
            "material: only the first 128 materials can be given colours");
  frame.texts = {text_column("name", {"a", "b"})};
  EXPECT_EQ(error_of(frame, {.color = MappedColors{.by = "name"}}),
            "color.by: the column 'name' is of texts, expected numbers");
}

}  // namespace
}  // namespace boule
