// Colours that a style gives: of kinds, of what is missing, of a name; and maps around 0.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

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
using test::text_column;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GivenColors, AreThoseGivenForKinds) {
  const ParticleFrame frame = row_of({"O", "Na+", "bead", "C"});
  const std::vector<KindColor> given{{"o", {1, 2, 3}}, {"bead", {4, 5, 6}}, {"Na", {7, 8, 9}}};
  EXPECT_THAT(colors_of(frame, {.colors = given}),
              ElementsAre("#010203", "#070809", "#040506", "#909090"));
  EXPECT_THAT(colors_of(frame, {.color = SrgbColor{16, 16, 16}, .colors = given}),
              ElementsAre("#010203", "#070809", "#040506", "#101010"));
  EXPECT_EQ(meaning_of(frame, {.colors = given}).species[2].color, (SrgbColor{4, 5, 6}));
  ParticleFrame chains = row_of({"C", "C", "C"});
  chains.texts = {text_column("chain", {"A", "c", "C"})};
  EXPECT_THAT(colors_of(chains, {.color = ColorColumns{{"chain"}}, .colors = {{"C", {1, 1, 1}}}}),
              ElementsAre("#e69f00", "#56b4e9", "#010101"));
  EXPECT_THAT(colors_of(row_with("type", {7, 1}),
                        {.color = ColorColumns{{"type"}}, .colors = {{"7", {1, 1, 1}}}}),
              ElementsAre("#010101", "#e69f00"));
}

TEST(GivenColors, AreGivenForKindsThatExist) {
  const ParticleFrame frame = row_of({"O", "bead"});
  const auto error = [&](const ParticleStyle& style) { return error_of(frame, style); };
  EXPECT_EQ(error({.colors = {{"Fe", {}}}}), "");  // an element that is absent
  EXPECT_EQ(error({.colors = {{"baed", {}}}}),
            "colors: no particle is of the kind 'baed', expected 'O' or 'bead'; did you mean "
            "'bead'?");
  EXPECT_EQ(error({.colors = {{"baed", {}}}, .lacks_kinds = true}), "");
  EXPECT_THAT(error({.color = MappedColors{"x"}, .colors = {{"O", {}}}}),
              HasSubstr("colors: expected colours by kind, but the colours are a scale of 'x'"));
  EXPECT_THAT(error_of(row_of_particles(1), {.colors = {{"O", {}}}}), HasSubstr("colors: "));
}

TEST(GivenColors, OfASeriesAreThoseGiven) {
  const ParticleStyle style{
      .color = ColorColumns{{"type"}}, .colors = {{"2", {1, 1, 1}}}, .lacks_kinds = true};
  ParticleChoices all;
  for (const double type : {1.0, 2.0})
    all.add(ParticleSpheres::make(row_with("type", {type}), style).value().own_choices());
  all.finish("all 2 frames");
  ASSERT_EQ(all.kinds.size(), 2U);
  EXPECT_EQ(all.kinds[1].color, (SrgbColor{1, 1, 1}));
  ParticleStyle chosen = style;
  chosen.chosen = &all;
  EXPECT_THAT(colors_of(row_with("type", {2}), chosen), ElementsAre("#010101"));
}

TEST(GivenColors, NamesMeanColorsWhereNoColumnDoes) {
  ParticleFrame frame = row_of({"C"});
  EXPECT_THAT(colors_of(frame, {.color = ColorColumns{{"Crimson"}}}), ElementsAre("#dc143c"));
  EXPECT_THAT(error_of(frame, {.color = ColorColumns{{"crimsn"}}}),
              HasSubstr("did you mean 'crimson'?"));
  frame.numbers = {{"red", {0.5}}};
  EXPECT_TRUE(meaning_of(frame, {.color = ColorColumns{{"red"}}}).scale);
}

TEST(GivenColors, OfWhatIsMissingAreChosen) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const SrgbColor white{255, 255, 255};
  const ParticleStyle style{.color = MappedColors{"q", ColorMap(), {{0, 1}}}, .nan_color = white};
  EXPECT_THAT(colors_of(row_with("q", {0, none}), style), ElementsAre("#440154", "#ffffff"));
  EXPECT_EQ(meaning_of(row_with("q", {0, none}), style).scale->nan_color, white);
  ParticleFrame chains = row_of({"C", "C"});
  chains.texts = {text_column("chain", {"", "A"})};
  EXPECT_THAT(colors_of(chains, {.color = ColorColumns{{"chain"}}}),
              ElementsAre("#a0a0a0", "#56b4e9"));
}

TEST(GivenColors, DivergingMapsAreEvenAround0) {
  const auto range = [](std::vector<double> numbers, NamedColorMap map) {
    return meaning_of(row_with("q", std::move(numbers)),
                      {.color = MappedColors{"q", ColorMap(map)}})
        .scale->range;
  };
  EXPECT_EQ(range({-1, 4}, NamedColorMap::coolwarm), (std::array{-4.0, 4.0}));
  EXPECT_EQ(range({-5, 4}, NamedColorMap::coolwarm), (std::array{-5.0, 5.0}));
  EXPECT_EQ(range({1, 4}, NamedColorMap::coolwarm), (std::array{1.0, 4.0}));
  EXPECT_EQ(range({-1, 4}, NamedColorMap::viridis), (std::array{-1.0, 4.0}));
  EXPECT_THAT(notes_of(row_with("q", {-1, 4}),
                       {.color = MappedColors{"q", ColorMap(NamedColorMap::coolwarm)}}),
              HasSubstr("go from -4 to 4, the 1st and 99th percentile, the same on both sides"));
}

}  // namespace
}  // namespace boule
