#include "core/math/color_names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace boule {
namespace {

TEST(ColorNames, AreThoseOfCss) {
  EXPECT_EQ(parse_color("crimson"), (SrgbColor{0xdc, 0x14, 0x3c}));
  EXPECT_EQ(parse_color("RebeccaPurple"), (SrgbColor{0x66, 0x33, 0x99}));
  EXPECT_EQ(parse_color("GREY"), parse_color("gray"));
  EXPECT_EQ(parse_color("white"), (SrgbColor{255, 255, 255}));
  EXPECT_EQ(parse_color("#336699"), (SrgbColor{0x33, 0x66, 0x99}));
}

TEST(ColorNames, AllAreFound) {
  const auto names = color_names();
  EXPECT_EQ(names.size(), 148U);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string_view name : names) EXPECT_TRUE(parse_color(name)) << name;
}

TEST(ColorNames, OtherTextIsNoColor) {
  for (const char* text : {"", "crimso", "crimson ", "#", "#33669", "transparent", "zzz", "\xff"})
    EXPECT_FALSE(parse_color(text)) << text;
}

}  // namespace
}  // namespace boule
