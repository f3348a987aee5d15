// What is drawn over a tone-mapped picture.
#include "render/image/pixel_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/encode_image.h"
#include "render/image/write_image.h"

namespace boule {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PixelLayer, CoversByItsAlpha) {
  const PixelLayer layer{4, 1, {9, 9, 9, 0, 10, 20, 30, 255, 255, 0, 0, 51, 0, 0, 0, 128}};
  std::vector<std::uint8_t> codes(12, 100);
  draw_over(layer, 0, 3, codes);
  EXPECT_THAT(codes, ElementsAre(100, 100, 100, 10, 20, 30, 131, 80, 80, 50, 50, 50));
}

TEST(PixelLayer, MakesTransparentPixelsOpaque) {
  const PixelLayer layer{3, 1, {10, 20, 30, 255, 10, 20, 30, 128, 0, 0, 0, 0}};
  std::vector<std::uint8_t> codes{0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4};
  draw_over(layer, 0, 4, codes);
  EXPECT_THAT(codes, ElementsAre(10, 20, 30, 255, 10, 20, 30, 128, 1, 2, 3, 4));
}

TEST(PixelLayer, HasTheSizeOfThePicture) {
  ImageFileOptions options;
  options.layer = std::make_shared<PixelLayer>(PixelLayer{1, 2, std::vector<std::uint8_t>(8, 255)});
  const auto drawn = encode_image(Image(1, 2), StreamFormat::rgb, "a", options);
  ASSERT_TRUE(drawn);
  EXPECT_EQ(drawn.value(), std::string(6, '\xff'));
  for (const StreamFormat format : {StreamFormat::rgb, StreamFormat::png}) {
    const auto wrong = encode_image(Image(2, 2), format, "a", options);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message, HasSubstr("not as large as the picture"));
  }
}

}  // namespace
}  // namespace boule
