#include "core/math/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace boule {
namespace {

TEST(Srgb, EveryCodeSurvivesARoundTrip) {
  const SrgbTable& table = SrgbTable::get();
  for (int code = 0; code < 256; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    EXPECT_EQ(table.code(table.linear(byte)), code);
  }
}

/// IEC 61966-2-1 the other way round, by the standard library.
double encoded(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

TEST(Srgb, ALinearValueHasTheNearestCode) {
  const SrgbTable& table = SrgbTable::get();
  for (int i = 0; i <= 10000; ++i) {
    const float v = static_cast<float>(i) / 10000;
    const double exact = encoded(static_cast<double>(v)) * 255;
    EXPECT_LE(std::abs(table.code(v) - exact), 0.5001) << v;
  }
}

TEST(Srgb, ClampsNumbersOutsideZeroToOne) {
  const SrgbTable& table = SrgbTable::get();
  for (const float low : {-1.0F, -0.0F, 0.0F, std::nanf("")}) EXPECT_EQ(table.code(low), 0);
  for (const float high : {1.0F, 1.5F, HUGE_VALF}) EXPECT_EQ(table.code(high), 255);
}

TEST(Srgb, HexColorsAreReadAndWritten) {
  EXPECT_EQ(parse_hex_color("#c04a0F"), (SrgbColor{0xc0, 0x4a, 0x0f}));
  EXPECT_EQ(hex_text({0xc0, 0x4a, 0x0f}), "#c04a0f");
  const Color color = linear_of({255, 188, 0});
  EXPECT_EQ(color.r, 1.0F);
  EXPECT_NEAR(color.g, 0.5028865, 1e-6);
  EXPECT_EQ(color.b, 0.0F);
  EXPECT_EQ(srgb_of(color), (SrgbColor{255, 188, 0}));
}

TEST(Srgb, RefusesInvalidHexColors) {
  for (const char* text : {"", "#", "c04040", "#c0404", "#c040400", "#c0404g", "# 04040", "#-14040",
                           "#+14040", "#0x4040", "#c0 040"}) {
    EXPECT_FALSE(parse_hex_color(text)) << text;
  }
}

}  // namespace
}  // namespace boule
