// What the colours of a picture mean, as SVG.
#include "render/apps/job/picture/legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace boule {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// How often a text occurs.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_THAT(ticks_within(0, 1), ElementsAre(0, 0.2, 0.4, 0.6000000000000001, 0.8, 1));
  EXPECT_THAT(ticks_within(-3, 14), ElementsAre(-2, 0, 2, 4, 6, 8, 10, 12, 14));
  for (const auto& [low, high] :
       {std::pair{-1e308, 1e308}, {1e-300, 3e-300}, {-0.37, -0.2}, {1e6, 1e6 + 1}, {0.0, 9.99}}) {
    const std::vector<double> ticks = ticks_within(low, high);
    EXPECT_GE(ticks.size(), 3U) << low << ' ' << high;
    EXPECT_LE(ticks.size(), 12U) << low << ' ' << high;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(ticks[i], low);
      EXPECT_LE(ticks[i], high);
      EXPECT_TRUE(i == 0 || ticks[i] > ticks[i - 1]);
    }
  }
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_LE(ticks_within(1.0, next).size(), 16U);
}

TEST(Legend, OfAMapHasTicks) {
  ParticleColors colors;
  colors.scale = ParticleColors::Scale{"|v| <m/s>", ColorMap({{255, 0, 0}, {0, 0, 255}}), {0, 10}};
  const std::string svg = legend_svg({colors});
  EXPECT_THAT(svg, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "));
  EXPECT_THAT(svg, HasSubstr(">|v| &lt;m/s&gt;</text>"));
  EXPECT_THAT(svg, HasSubstr("<stop offset=\"0\" stop-color=\"#ff0000\"/>"));
  EXPECT_THAT(svg, HasSubstr("<stop offset=\"1\" stop-color=\"#0000ff\"/>"));
  for (const char* tick : {">0<", ">2<", ">4<", ">6<", ">8<", ">10<"}) {
    EXPECT_THAT(svg, HasSubstr(tick));
  }
  EXPECT_EQ(count(svg, "<text"), 7);
  EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
}

TEST(Legend, TellsTheColorOfWhatIsMissing) {
  ParticleColors colors;
  colors.scale = ParticleColors::Scale{"q", ColorMap({{255, 0, 0}, {0, 0, 255}}), {0, 10}};
  EXPECT_THAT(legend_svg({colors}), Not(HasSubstr(">missing<")));
  colors.scale->missing = 3;
  const std::string svg = legend_svg({colors});
  EXPECT_THAT(svg, HasSubstr(">missing</text>"));
  EXPECT_THAT(svg, HasSubstr("fill=\"#a0a0a0\""));
  ParticleColors kinds;
  kinds.species = {{"", {1, 2, 3}, 1}};
  EXPECT_THAT(legend_svg({kinds}), HasSubstr(">missing</text>"));
}

TEST(Legend, OfSpeciesIsAList) {
  ParticleColors colors;
  colors.species = {{"Au", {255, 209, 35}, 405}, {"C\xff\n", {144, 144, 144}, 2}};
  const std::string svg = legend_svg({colors});
  EXPECT_THAT(svg, HasSubstr("fill=\"#ffd123\""));
  EXPECT_THAT(svg, HasSubstr(">Au</text>"));
  EXPECT_THAT(svg, HasSubstr(">C?"
                             "?</text>"));
  EXPECT_EQ(count(svg, "<circle"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("linearGradient")));
}

TEST(Legend, OfManySpeciesHasColumns) {
  ParticleColors colors;
  for (int i = 0; i < 45; ++i) colors.species.push_back({std::to_string(i), {}, 1});
  const std::string svg = legend_svg({colors});
  EXPECT_EQ(count(svg, "<circle"), 45);
  EXPECT_EQ(count(svg, "cx=\"19.0\""), 15);
}

TEST(Legend, OfOtherColorsIsNone) {
  EXPECT_EQ(legend_svg({}), "");
  EXPECT_EQ(legend_svg({ParticleColors{}}), "");
}

}  // namespace
}  // namespace boule
