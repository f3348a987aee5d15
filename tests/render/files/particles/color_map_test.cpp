#include "render/files/particles/colors/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace boule {
namespace {

int farthest_code(const SrgbColor& a, const SrgbColor& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// matplotlib's colours 0, 64, 128, 200 and 255 of 256. Those at the ends are exact.
TEST(ColorMap, HasTheColorsOfItsName) {
  struct Known {
    NamedColorMap map;
    std::array<const char*, 5> colors;
  };
  using Map = NamedColorMap;
  for (const Known& known :
       {Known{Map::viridis, {"#440154", "#3b528b", "#21918c", "#70cf57", "#fde725"}},
        Known{Map::magma, {"#000004", "#51127c", "#b73779", "#fd9869", "#fcfdbf"}},
        Known{Map::plasma, {"#0d0887", "#7e03a8", "#cc4778", "#fba139", "#f0f921"}},
        Known{Map::inferno, {"#000004", "#57106e", "#bc3754", "#fb9d07", "#fcffa4"}},
        Known{Map::cividis, {"#00224e", "#434e6c", "#7d7c78", "#c4b468", "#fee838"}},
        Known{Map::coolwarm, {"#3b4cc0", "#8db0fe", "#dddcdc", "#f08b6e", "#b40426"}},
        Known{Map::turbo, {"#30123b", "#28bceb", "#a4fc3c", "#f46617", "#7a0403"}},
        Known{Map::grey, {"#000000", "#404040", "#808080", "#c8c8c8", "#ffffff"}}}) {
    const ColorMap map(known.map);
    constexpr std::array indices{0, 64, 128, 200, 255};
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const SrgbColor color = map.color(indices[i] / 255.0);
      const int most = i == 0 || i == 4 ? 0 : known.map == Map::cividis ? 2 : 1;
      EXPECT_LE(farthest_code(color, *parse_hex_color(known.colors[i])), most)
          << name_of(known.map) << " " << indices[i] << " " << hex_text(color);
    }
  }
}

TEST(ColorMap, NamesHaveAnyCaseAndAReverse) {
  for (const std::string_view name : names<NamedColorMap>) {
    const auto map = named_color_map(name);
    const auto reversed = named_color_map(std::string(name) + "_R");
    ASSERT_TRUE(map && reversed) << name;
    for (const double at : {0.0, 0.3, 1.0}) EXPECT_EQ(map->color(at), reversed->color(1 - at));
    EXPECT_EQ(map->is_diverging(), name == "coolwarm");
    EXPECT_EQ(reversed->is_diverging(), map->is_diverging());
  }
  EXPECT_EQ(named_color_map("ViriDis")->color(0), (SrgbColor{0x44, 0x01, 0x54}));
  for (const char* text : {"", "_r", "viridis_r_r", "viridis ", "rainbow"})
    EXPECT_FALSE(named_color_map(text)) << text;
  EXPECT_EQ(did_you_mean_map("Virdis_r"), "; did you mean 'viridis_r'?");
  EXPECT_EQ(did_you_mean_map("rainbow"), "");
}

TEST(ColorMap, GreyIsGreyAndGrows) {
  const ColorMap map(NamedColorMap::grey);
  for (int i = 0; i <= 255; ++i) {
    const SrgbColor color = map.color(i / 255.0);
    EXPECT_NEAR(color.r, i, 1);
    EXPECT_EQ(color.r, color.g);
    EXPECT_EQ(color.r, color.b);
  }
}

TEST(ColorMap, ClampsToItsEnds) {
  const ColorMap map(NamedColorMap::turbo);
  for (const double below : {-1e-300, -1.0, -1e308, -HUGE_VAL}) {
    EXPECT_EQ(map.color(below), map.color(0));
  }
  for (const double above : {1.0000001, 2.0, 1e308, HUGE_VAL}) {
    EXPECT_EQ(map.color(above), map.color(1));
  }
}

TEST(ColorMap, GoesStraightBetweenColors) {
  const ColorMap map({{0, 100, 255}, {100, 100, 55}, {100, 0, 55}});
  EXPECT_EQ(map.color(0), (SrgbColor{0, 100, 255}));
  EXPECT_EQ(map.color(0.25), (SrgbColor{50, 100, 155}));
  EXPECT_EQ(map.color(0.5), (SrgbColor{100, 100, 55}));
  EXPECT_EQ(map.color(0.75), (SrgbColor{100, 50, 55}));
  EXPECT_EQ(map.color(1), (SrgbColor{100, 0, 55}));
}

TEST(ColorMap, OneColorIsEverywhere) {
  const ColorMap map({{1, 2, 3}});
  for (const double at : {-1.0, 0.0, 0.5, 1.0, 2.0}) EXPECT_EQ(map.color(at), (SrgbColor{1, 2, 3}));
}

}  // namespace
}  // namespace boule
