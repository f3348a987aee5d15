#include "render/image/image_format.h"

#include <gtest/gtest.h>

#include "tests/render/image/files.h"

namespace boule {
namespace {

TEST(ImageFormat, KnownNames) {
  for (const char* name :
       {"a.exr", "a.EXR", "dir.x/a.Png", "a.b.jpg", ".hidden.tga", "a.jpeg", "a.jpe", "a.tif",
        "a.tiff", "a.hdr", "a.rgbe", "a.ppm", "a.pnm", "a.bmp", "a.webp", "/abs/####.png"}) {
    EXPECT_NE(find_image_format(name), nullptr) << name;
  }
}

TEST(ImageFormat, UnknownNames) {
  for (const char* name : {"", ".", "..", "png", ".png", "a.", "a.pn", "a.pngx", "a.png/",
                           "a.png/b", "a.gif", "a.toml", "/dev/null", "a png", "a.png "}) {
    EXPECT_EQ(find_image_format(name), nullptr) << name;
  }
}

TEST(ImageFormat, OnlyExrHoldsChannels) {
  EXPECT_TRUE(find_image_format("a.exr")->channels);
  EXPECT_TRUE(find_image_format("a.exr")->hdr);
  EXPECT_TRUE(find_image_format("a.hdr")->hdr);
  EXPECT_FALSE(find_image_format("a.hdr")->channels);
  EXPECT_FALSE(find_image_format("a.tif")->hdr);
}

TEST(ImageFormat, SomeHoldRemarks) {
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.tiff", "a.tga"})
    EXPECT_TRUE(find_image_format(name)->remarks) << name;
  for (const char* name : {"a.hdr", "a.webp", "a.ppm", "a.bmp"})
    EXPECT_FALSE(find_image_format(name)->remarks) << name;
}

TEST(ImageFormat, AskingLoadsNothing) {
  ASSERT_NE(find_image_format("a.png"), nullptr);
  EXPECT_EQ(known_image_extensions().substr(0, 5), "exr, ");
  const std::string mapped = test::read_bytes("/proc/self/maps");
  EXPECT_NE(mapped.find("libstdc++"), std::string::npos);
  EXPECT_EQ(mapped.find("libOpenImageIO"), std::string::npos);
  EXPECT_EQ(mapped.find("boule_image_io"), std::string::npos);
}

}  // namespace
}  // namespace boule
