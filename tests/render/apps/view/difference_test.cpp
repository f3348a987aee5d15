// False colours of how far two panes are apart.
#include "render/apps/view/panes/difference.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace boule::view {
namespace {

Color shown(SrgbColor color) { return linear_of(color); }

TEST(Difference, OfColoursIsThatOfTheirCodes) {
  Image a(5, 1), b(5, 1);
  for (int x = 0; x < 5; ++x) a.at(x, 0) = b.at(x, 0) = linear_of({100, 100, 100});
  b.at(1, 0) = linear_of({100, 101, 100});
  b.at(2, 0) = linear_of({96, 100, 101});
  b.at(3, 0) = linear_of({100, 100, 164});
  b.at(4, 0) = linear_of({255, 0, 0});
  const DifferencePicture made = color_difference(a, b, 0);
  EXPECT_EQ(made.pixels, 4u);
  EXPECT_EQ(made.largest, 155);
  EXPECT_EQ(made.image.at(0, 0), Color{});
  EXPECT_EQ(made.image.at(1, 0), shown(false_colors[1]));
  EXPECT_EQ(made.image.at(2, 0), shown(false_colors[2]));
  EXPECT_EQ(made.image.at(3, 0), shown(false_colors[4]));
  EXPECT_EQ(made.image.at(4, 0), shown(false_colors[4]));
}

TEST(Difference, OfTCountsFloats) {
  const auto after = [](float x, std::uint32_t floats) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + floats);
  };
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<PixelHit> a = {{2, 0}, {2, 0}, {2, 0}, {2, 0}, {infinite, 9}};
  const std::vector<PixelHit> b = {
      {2, 0}, {after(2, 1), 0}, {after(2, 256), 0}, {5, 1}, {infinite, 9}};
  const DifferencePicture made = t_difference(a, b, 5, 1);
  EXPECT_EQ(made.pixels, 3u);
  EXPECT_EQ(made.largest, 256);
  EXPECT_EQ(made.image.at(0, 0), Color{});
  EXPECT_EQ(made.image.at(1, 0), shown(false_colors[1]));
  EXPECT_EQ(made.image.at(2, 0), shown(false_colors[3]));
  EXPECT_EQ(made.image.at(3, 0), shown(other_primitive));
  EXPECT_EQ(made.image.at(4, 0), Color{});
}

TEST(Difference, OfOtherSizesIsNone) {
  EXPECT_EQ(color_difference(Image(2, 2), Image(3, 2), 0).pixels, 0u);
  EXPECT_EQ(t_difference({{1, 1}}, {}, 1, 1).pixels, 0u);
}

}  // namespace
}  // namespace boule::view
