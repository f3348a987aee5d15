#include "render/image/tone.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace boule::tone {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

/// The formula of the standard, in extended precision.
int formula(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const long double v = static_cast<long double>(linear);
  const long double s = v <= 0.0031308L ? 12.92L * v : 1.055L * std::pow(v, 1.0L / 2.4L) - 0.055L;
  return static_cast<int>(std::floor(255 * s + 0.5L));
}

/// The smallest float to which the formula gives at least this code.
float boundary(int code) {
  std::uint32_t below = 0, at = std::bit_cast<std::uint32_t>(1.0F);
  while (at - below > 1) {
    const std::uint32_t middle = below + (at - below) / 2;
    (formula(std::bit_cast<float>(middle)) >= code ? at : below) = middle;
  }
  return std::bit_cast<float>(at);
}

/// The code that tone_map() gives a linear value.
int srgb_code(float linear) {
  Image image(1, 1);
  image.at(0, 0).r = linear;
  return tone_map(image, 0)[0];
}

TEST(Tone, EveryBoundaryIsTheFormulas) {
  for (int code = 1; code < 256; ++code) {
    const float first = boundary(code);
    EXPECT_EQ(srgb_code(first), code);
    EXPECT_EQ(srgb_code(std::nextafter(first, 0.0F)), code - 1);
  }
}

TEST(Tone, FloatsOfEveryMagnitudeFollowTheFormula) {
  for (std::uint32_t bits = 0; bits <= 0x3f900000; bits += 1009) {
    const float linear = std::bit_cast<float>(bits);
    ASSERT_EQ(srgb_code(linear), formula(linear)) << linear;
  }
}

TEST(Tone, ValuesOutsideTheRangeAreClamped) {
  EXPECT_EQ(srgb_code(-0.0F), 0);
  EXPECT_EQ(srgb_code(-1), 0);
  EXPECT_EQ(srgb_code(-inf), 0);
  EXPECT_EQ(srgb_code(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(srgb_code(1), 255);
  EXPECT_EQ(srgb_code(std::numeric_limits<float>::max()), 255);
  EXPECT_EQ(srgb_code(inf), 255);
  EXPECT_EQ(srgb_code(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(srgb_code(-std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Tone, ChannelsKeepTheirOrder) {
  Image image(2, 1);
  image.at(0, 0) = {1, 0.5F, 0};
  image.at(1, 0) = {0.25F, 0, 2};
  EXPECT_EQ(tone_map(image, 0), (std::vector<std::uint8_t>{255, 188, 0, 137, 0, 255}));
}

struct Exposure {
  float stops, factor;
};

TEST(Tone, ExposureMultipliesByAPowerOfTwo) {
  constexpr Exposure cases[] = {{0, 1}, {1, 2},        {-1, 0.5F},
                                {3, 8}, {-4, 0.0625F}, {0.5F, 1.4142135F}};
  for (const Exposure& exposure : cases) {
    for (const float linear : {0.001F, 0.02F, 0.1F, 0.3F, 0.7F, 1.0F, 5.0F}) {
      Image image(1, 1);
      image.at(0, 0) = {linear, linear, linear};
      EXPECT_EQ(tone_map(image, exposure.stops)[0], formula(linear * exposure.factor))
          << linear << " at " << exposure.stops;
    }
  }
}

TEST(Tone, ExcessiveExposureIsBounded) {
  Image image(3, 1);
  image.pixels = {{0, 0, 0}, {1, 1, 1}, {inf, inf, inf}};
  const std::vector<std::uint8_t> bright = {0, 0, 0, 255, 255, 255, 255, 255, 255};
  const std::vector<std::uint8_t> dark = {0, 0, 0, 0, 0, 0, 255, 255, 255};
  EXPECT_EQ(tone_map(image, inf), bright);
  EXPECT_EQ(tone_map(image, 1e30F), bright);
  EXPECT_EQ(tone_map(image, -inf), dark);
  EXPECT_EQ(tone_map(image, std::numeric_limits<float>::quiet_NaN()), tone_map(image, 0));
}

}  // namespace
}  // namespace boule::tone
