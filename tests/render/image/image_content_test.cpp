// What is in written pictures, read back by OpenImageIO itself. Only this test program links it.

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/image/tone.h"
#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

using OIIO::TypeDesc;

class ImageContent : public testing::Test {
 protected:
  /// Writes a picture as NAME and opens it.
  void round_trip(const Image& image, const std::string& name,
                  const ImageFileOptions& options = {}) {
    const std::string path = (dir_.path() / name).string();
    const Status done = write_image(image, path, options);
    ASSERT_TRUE(done) << done.error().message;
    input_ = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input_) << OIIO::geterror();
  }
  [[nodiscard]] std::string path_of(const char* name) const {
    return (dir_.path() / name).string();
  }
  /// The codes of a file with alpha as they stand in it.
  [[nodiscard]] std::vector<std::uint8_t> straight_codes(const char* name) const {
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path_of(name), &wishes);
    std::vector<std::uint8_t> codes(static_cast<std::size_t>(spec().width * spec().height * 4));
    EXPECT_TRUE(input && input->read_image(0, 0, 0, 4, TypeDesc::UINT8, codes.data()));
    return codes;
  }
  [[nodiscard]] const OIIO::ImageSpec& spec() const { return input_->spec(); }

  /// Channels [begin, end) of all pixels, interleaved.
  template <class T>
  std::vector<T> samples(int begin, int end, TypeDesc type) {
    const auto pixels =
        static_cast<std::size_t>(spec().width) * static_cast<std::size_t>(spec().height);
    std::vector<T> values(pixels * static_cast<std::size_t>(end - begin));
    EXPECT_TRUE(input_->read_image(0, 0, begin, end, type, values.data())) << input_->geterror();
    return values;
  }
  std::vector<std::uint8_t> codes() { return samples<std::uint8_t>(0, 3, TypeDesc::UINT8); }
  std::vector<float> floats() { return samples<float>(0, 3, TypeDesc::FLOAT); }
  /// One named channel.
  template <class T>
  std::vector<T> channel(const std::string& name, TypeDesc type) {
    const int at = spec().channelindex(name);
    EXPECT_GE(at, 0) << name;
    EXPECT_EQ(spec().channelformat(at), type) << name;
    return samples<T>(at, at + 1, type);
  }

 private:
  test::TempDir dir_;
  OIIO::ImageInput::unique_ptr input_;
};

/// Colours that are premultiplied by these alphas.
Image half_covered() {
  Image image(3, 1, Alpha::coverage);
  image.set(0, {0.25f, 0.125f, 0}, 0.5f);
  image.set(1, {1, 0.5f, 0.25f}, 1);
  return image;
}

std::vector<float> floats_of(const Image& image) {
  std::vector<float> values;
  for (const Color& color : image.pixels) values.insert(values.end(), {color.r, color.g, color.b});
  return values;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Image extremes() {
  using Limits = std::numeric_limits<float>;
  Image image(3, 2);
  image.pixels = {{0, -0.0F, 1},
                  {Limits::max(), Limits::lowest(), Limits::min()},
                  {Limits::denorm_min(), Limits::infinity(), 0.1F},
                  {1e-20F, 1e20F, 65504.0F},
                  {0.25F, 65536.0F, 2.0F},
                  {1.0F / 3, 3, 5}};
  return image;
}

TEST_F(ImageContent, ExrKeepsEveryBit) {
  for (const Compression compression : {Compression::none, Compression::rle, Compression::zip}) {
    ImageFileOptions options;
    options.compression = compression;
    options.exposure_stops = 3;  // of LDR formats only
    for (const Image& image : {extremes(), test::noise(33, 200), Image(1, 1)}) {
      round_trip(image, "a.exr", options);
      EXPECT_EQ(spec().nchannels, 3);
      EXPECT_EQ(spec().format, TypeDesc::FLOAT);
      EXPECT_TRUE(same_bits(floats(), floats_of(image)));
    }
  }
}

TEST_F(ImageContent, ExrSaysHowItIsPacked) {
  constexpr std::pair<Compression, const char*> cases[] = {
      {Compression::none, "none"}, {Compression::rle, "rle"}, {Compression::zip, "zip"}};
  for (const auto& [compression, name] : cases) {
    ImageFileOptions options;
    options.compression = compression;
    round_trip(test::noise(8, 8), "a.exr", options);
    EXPECT_EQ(spec().get_string_attribute("compression"), name);
  }
}

TEST_F(ImageContent, LosslessFormatsHoldTheToneMappedBytes) {
  for (const char* name :
       {"a.png", "a.tif", "a.tiff", "a.ppm", "a.pnm", "a.bmp", "a.tga", "a.PNG"}) {
    for (const Image& image : {test::noise(37, 150), Image(1, 1), test::noise(1, 5)}) {
      ImageFileOptions options;
      options.exposure_stops = -0.5F;
      round_trip(image, name, options);
      EXPECT_EQ(spec().nchannels, 3) << name;
      EXPECT_EQ(spec().format, TypeDesc::UINT8) << name;
      EXPECT_TRUE(codes() == tone_map(image, options.exposure_stops)) << name;
    }
  }
}

TEST_F(ImageContent, LossyFormatsAreClose) {
  Image image(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float right = static_cast<float>(x) / 64, down = static_cast<float>(y) / 48;
      image.at(x, y) = {0.2F + 0.4F * right, 0.2F + 0.6F * down, 0.3F};
    }
  }
  const std::vector<std::uint8_t> wanted = tone_map(image, 0);
  // At quality 95 a smooth ramp stays within a few codes, but not with swapped channels or rows.
  for (const char* name : {"a.jpg", "a.jpeg", "a.jpe", "a.webp"}) {
    round_trip(image, name);
    ASSERT_EQ(spec().nchannels, 3) << name;
    const std::vector<std::uint8_t> found = codes();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      ASSERT_NEAR(found[i], wanted[i], 6) << name << " at " << i;
    }
  }
}

TEST_F(ImageContent, HdrKeepsEightBitsOfTheBrightest) {
  Image image = test::noise(50, 20);
  image.at(3, 3) = {1000, 1, 0};
  for (const char* name : {"a.hdr", "a.rgbe"}) {
    round_trip(image, name);
    const std::vector<float> found = floats(), wanted = floats_of(image);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Color& pixel = image.pixels[i / 3];
      ASSERT_NEAR(found[i], wanted[i], std::max({pixel.r, pixel.g, pixel.b}) / 128) << name << i;
    }
  }
}

TEST_F(ImageContent, ExtraChannelsOfTwoTypes) {
  const Image image = test::noise(5, 70);
  std::vector<float> depth(350);
  std::vector<std::uint32_t> ids(350);
  for (std::size_t i = 0; i < 350; ++i) {
    depth[i] = static_cast<float>(i) * 0.1F;
    ids[i] = i % 3 == 0 ? 4294967295U : static_cast<std::uint32_t>(i * 20000003U);
  }
  depth[7] = std::numeric_limits<float>::infinity();
  std::vector<float> normal(350, -0.5F), albedo(350, 0.75F);
  for (const Compression compression : {Compression::none, Compression::rle, Compression::zip}) {
    ImageFileOptions options;
    options.compression = compression;
    options.channels = {{"Z", depth}, {"id", ids}, {"N.X", normal}, {"albedo.R", albedo}};
    round_trip(image, "a.exr", options);
    ASSERT_EQ(spec().nchannels, 7);
    EXPECT_EQ(channel<float>("Z", TypeDesc::FLOAT), depth);
    EXPECT_EQ(channel<std::uint32_t>("id", TypeDesc::UINT32), ids);
    EXPECT_EQ(channel<float>("N.X", TypeDesc::FLOAT), normal);
    EXPECT_EQ(channel<float>("albedo.R", TypeDesc::FLOAT), albedo);
    const std::vector<float> green = channel<float>("G", TypeDesc::FLOAT);
    for (std::size_t i = 0; i < 350; ++i) ASSERT_EQ(green[i], image.pixels[i].g);
  }
}

TEST_F(ImageContent, CropsBecomeExrDataWindows) {
  const Image image = test::noise(20, 10);
  ImageFileOptions options;
  options.crop = {640, 480, 100, 470};
  options.channels = {{"id", std::vector<std::uint32_t>(200, 9)}};
  round_trip(image, "a.exr", options);
  EXPECT_EQ(spec().x, 100);
  EXPECT_EQ(spec().y, 470);
  EXPECT_EQ(spec().width, 20);
  EXPECT_EQ(spec().height, 10);
  EXPECT_EQ(spec().full_x, 0);
  EXPECT_EQ(spec().full_y, 0);
  EXPECT_EQ(spec().full_width, 640);
  EXPECT_EQ(spec().full_height, 480);
  EXPECT_EQ(channel<std::uint32_t>("id", TypeDesc::UINT32), std::vector<std::uint32_t>(200, 9));
}

TEST_F(ImageContent, OtherFormatsHoldTheCroppedPixelsOnly) {
  const Image image = test::noise(20, 10);
  ImageFileOptions options;
  options.crop = {640, 480, 100, 50};
  for (const char* name : {"a.png", "a.tif", "a.ppm", "a.bmp", "a.tga"}) {
    round_trip(image, name, options);
    EXPECT_EQ(spec().x, 0) << name;
    EXPECT_EQ(spec().width, 20) << name;
    EXPECT_EQ(spec().full_width, 20) << name;
    EXPECT_EQ(spec().full_height, 10) << name;
    EXPECT_TRUE(codes() == tone_map(image, 0)) << name;
  }
}

TEST_F(ImageContent, ExrHeaderHoldsEveryKind) {
  MetadataMatrix matrix{};
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = static_cast<float>(i) + 0.5F;
  ImageFileOptions options;
  options.metadata = {{"boule:solver", "fast"},
                      {"samplesPerPixel", 16},
                      {"boule:weight", 0.1F},
                      {"worldtocamera", matrix},
                      {"worldtoscreen", matrix}};
  round_trip(Image(2, 2), "a.exr", options);
  EXPECT_TRUE(std::string(spec().get_string_attribute("Software")).starts_with("boule "));
  EXPECT_EQ(spec().get_string_attribute("DateTime"), "1970:01:01 00:00:00");
  EXPECT_EQ(spec().get_string_attribute("oiio:ColorSpace"), "Linear");
  EXPECT_EQ(spec().get_string_attribute("boule:solver"), "fast");
  EXPECT_EQ(spec().get_int_attribute("samplesPerPixel"), 16);
  EXPECT_EQ(spec().get_float_attribute("boule:weight"), 0.1F);
  for (const char* name : {"worldtocamera", "worldtoscreen"}) {
    MetadataMatrix found{};
    ASSERT_TRUE(spec().getattribute(name, OIIO::TypeMatrix44, found.data())) << name;
    EXPECT_EQ(found, matrix) << name;
  }
}

TEST_F(ImageContent, LdrHeadersSayWhoAndWhen) {
  ImageFileOptions options;
  options.date_time = "2001:02:03 04:05:06";
  options.metadata = {{"worldtocamera", MetadataMatrix{}}, {"boule:seed", 7}};
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
    round_trip(test::noise(9, 9), name, options);
    EXPECT_TRUE(std::string(spec().get_string_attribute("Software")).starts_with("boule ")) << name;
    EXPECT_EQ(spec().get_string_attribute("DateTime"), options.date_time) << name;
    if (std::string(name) == "a.tif") continue;  // 8-bit TIFF does not store it: sRGB is understood
    EXPECT_EQ(spec().get_string_attribute("oiio:ColorSpace"), "sRGB") << name;
  }
}

TEST_F(ImageContent, WideAndTall) {
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.tga", "a.ppm"}) {
    round_trip(Image(65000, 1), name);
    EXPECT_EQ(spec().width, 65000) << name;
    round_trip(Image(1, 65000), name);
    EXPECT_EQ(spec().height, 65000) << name;
  }
  const Image wide = test::noise(40000, 1);  // wider than the Radiance format can run-length encode
  round_trip(wide, "a.hdr");
  EXPECT_NEAR(floats()[119999], wide.at(39999, 0).b, 0.01F);
}

TEST_F(ImageContent, ExrHoldsAlphaBesidePremultipliedColours) {
  const Image image = half_covered();
  ASSERT_NO_FATAL_FAILURE(round_trip(image, "alpha.exr"));
  EXPECT_EQ(spec().nchannels, 4);
  EXPECT_EQ(channel<float>("R", TypeDesc::FLOAT), (std::vector<float>{0.25f, 1, 0}));
  EXPECT_EQ(channel<float>("A", TypeDesc::FLOAT), image.alpha);
}

TEST_F(ImageContent, PngHoldsAlphaBesideStraightColours) {
  const Image image = half_covered();
  ASSERT_NO_FATAL_FAILURE(round_trip(image, "alpha.png"));
  EXPECT_EQ(spec().nchannels, 4);
  // OpenImageIO multiplies by alpha what it reads, so the file's own codes are told by tone_map().
  const std::vector<std::uint8_t> expected = {188, 137, 0, 128, 255, 188, 137, 255, 0, 0, 0, 0};
  EXPECT_EQ(tone_map(image, 0), expected);
  EXPECT_EQ(straight_codes("alpha.png"), expected);
}

TEST_F(ImageContent, OtherFormatsRefuseAlpha) {
  for (const char* name : {"a.jpg", "a.ppm", "a.hdr", "a.tif"}) {
    const Status done = write_image(half_covered(), path_of(name));
    ASSERT_FALSE(done) << name;
    EXPECT_NE(done.error().message.find("has no room for transparency"), std::string::npos) << name;
  }
  Image image = half_covered();
  image.alpha.pop_back();
  EXPECT_FALSE(write_image(image, path_of("a.png")));
}

}  // namespace
}  // namespace boule
