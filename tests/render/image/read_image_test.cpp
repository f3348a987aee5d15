// Pictures that were written are read again, and other files are refused.
#include "render/image/read_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/math/srgb.h"
#include "render/image/tone.h"
#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

class ReadImage : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  std::string written(const Image& image, const std::string& name,
                      const ImageFileOptions& options = {}) const {
    const Status done = write_image(image, path(name), options);
    EXPECT_TRUE(done) << done.error().message;
    return path(name);
  }
  static Image read(const std::string& file, PictureContent content) {
    auto image = read_image(file, content);
    if (!image) ADD_FAILURE() << image.error().message;
    return image ? std::move(image).value() : Image();
  }
  void expect_refused(const std::string& name, const std::string& message) const {
    const auto image = read_image(path(name), PictureContent::colors);
    ASSERT_FALSE(image) << name;
    EXPECT_EQ(image.error().file, path(name));
    EXPECT_NE(image.error().message.find(message), std::string::npos) << image.error().message;
    EXPECT_EQ(image.error().message.find('\n'), std::string::npos);
  }

  TempDir dir_;
};

TEST_F(ReadImage, FloatsComeBackBitForBit) {
  Image image = noise(37, 21);
  image.at(0, 0) = {-1.5F, 1e30F, 1e-40F};
  for (const PictureContent content : {PictureContent::colors, PictureContent::numbers}) {
    const Image found = read(written(image, "noise.exr"), content);
    ASSERT_EQ(found.width, 37);
    ASSERT_EQ(found.height, 21);
    EXPECT_EQ(std::memcmp(found.pixels.data(), image.pixels.data(), 37 * 21 * sizeof(Color)), 0);
  }
}

TEST_F(ReadImage, CodesAreNumbersOrColours) {
  Image image(256, 1);
  for (int code = 0; code < 256; ++code) {
    image.at(code, 0) = gray(static_cast<float>(linear_from_srgb(code / 255.0)));
  }
  for (const char* name : {"codes.png", "codes.tif", "codes.ppm", "codes.bmp", "codes.tga"}) {
    const std::string file = written(image, name);
    const Image numbers = read(file, PictureContent::numbers);
    const Image colors = read(file, PictureContent::colors);
    for (int code = 0; code < 256; ++code) {
      EXPECT_EQ(numbers.at(code, 0).r, static_cast<float>(code) / 255) << name << code;
      EXPECT_NEAR(colors.at(code, 0).g, image.at(code, 0).g, 1e-6F) << name << code;
    }
  }
}

TEST_F(ReadImage, RowZeroIsOnTop) {
  Image image(2, 3);
  image.at(1, 0) = {1, 0, 0};
  image.at(0, 2) = {0, 0, 1};
  for (const char* name : {"rows.exr", "rows.png", "rows.bmp", "rows.tga", "rows.hdr"}) {
    const Image found = read(written(image, name), PictureContent::colors);
    ASSERT_EQ(found.pixels.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(found.pixels[i], image.pixels[i]) << name << i;
  }
}

TEST_F(ReadImage, OtherChannelsDoNotMatter) {
  ImageFileOptions options;
  options.channels = {{"A", std::vector<float>(4, 0.5F)}, {"Z", std::vector<float>(4, 7)}};
  Image image(2, 2);
  image.pixels = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  const Image found = read(written(image, "more.exr", options), PictureContent::numbers);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(found.pixels[i], image.pixels[i]);
}

TEST_F(ReadImage, OneGrayChannelIsThree) {
  write_bytes(path("gray.ppm"), std::string("P5 2 1 255\n\x00\xff", 13));
  const Image found = read(path("gray.ppm"), PictureContent::numbers);
  ASSERT_EQ(found.pixels.size(), 2U);
  EXPECT_EQ(found.pixels[0], gray(0));
  EXPECT_EQ(found.pixels[1], gray(1));
}

TEST_F(ReadImage, OtherFilesAreRefused) {
  expect_refused("missing.exr", "cannot read it: ");
  expect_refused("picture.gif", "unknown extension, expected one of exr, hdr");
  expect_refused("noextension", "unknown extension");
  write_bytes(path("text.exr"), "schema = 1\n");
  expect_refused("text.exr", "cannot read it: ");
  write_bytes(path("empty.png"), "");
  expect_refused("empty.png", "cannot read it: ");
  std::filesystem::create_directory(path("folder.exr"));
  expect_refused("folder.exr", "cannot read it: ");
}

TEST_F(ReadImage, APartOfAPictureIsRefused) {
  ImageFileOptions options;
  options.crop = {8, 8, 2, 3};
  const std::string part = written(Image(4, 4), "part.exr", options);
  const auto found = read_image(part, PictureContent::numbers);
  ASSERT_FALSE(found.ok());
  EXPECT_NE(found.error().message.find("data window"), std::string::npos);
}

TEST_F(ReadImage, AFileCutShortIsRefused) {
  for (const char* name : {"cut.exr", "cut.png", "cut.tif", "cut.jpg", "cut.hdr", "cut.ppm"}) {
    const std::string bytes = read_bytes(written(noise(64, 64), name));
    for (const std::size_t left : {bytes.size() / 4, bytes.size() / 2}) {
      write_bytes(path(name), bytes.substr(0, left));
      expect_refused(name, "cannot read it: ");
    }
  }
}

/// libpng and libjpeg would complain on standard error, or make up the rest.
TEST_F(ReadImage, TruncatedPngAndJpegAreRefused) {
  for (const char* name : {"cut.png", "cut.jpg"}) {
    const std::string bytes = read_bytes(written(noise(20, 20), name));
    for (std::size_t left = 8; left < bytes.size(); left += 11) {
      write_bytes(path(name), bytes.substr(0, left));
      expect_refused(name, "the file ends within the picture");
    }
    write_bytes(path(name), bytes + "what some cameras put behind it");
    EXPECT_EQ(read(path(name), PictureContent::colors).width, 20);
  }
}

/// libpng would complain on standard error. Damage in an optional chunk is no reason to refuse.
TEST_F(ReadImage, DamagedPngChunksAreRefused) {
  ImageFileOptions options;
  options.date_time = "1970:01:01 00:00:00";
  const std::string file = written(noise(200, 100), "bad.png", options), bytes = read_bytes(file);
  const auto read_with_damage_at = [&](std::size_t at) {
    std::string bad = bytes;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    write_bytes(file, bad);
    return read_image(file, PictureContent::colors).ok();
  };
  testing::internal::CaptureStderr();
  const std::size_t data = bytes.find("IDAT");
  for (const std::size_t at : {std::size_t{20}, data + 10, bytes.size() / 2, bytes.size() - 2}) {
    EXPECT_FALSE(read_with_damage_at(at)) << at;
    expect_refused("bad.png", "cannot read it: a checksum in the file is wrong");
  }
  const std::size_t text = bytes.find("tEXt");
  ASSERT_NE(text, std::string::npos);
  EXPECT_TRUE(read_with_damage_at(text + 5));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Its header alone would take 48 GiB.
TEST_F(ReadImage, AHeaderWithoutPixelsTakesNoMemory) {
  write_bytes(path("header.ppm"), "P6 65535 65535 255\n");
  expect_refused("header.ppm", "cannot read it: ");
}

}  // namespace
}  // namespace boule::test
