// Which files is_finished_picture() takes for finished pictures.

#include "render/image/finished_picture.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <climits>
#include <string>
#include <vector>

#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

class FinishedPicture : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (dir_.path() / name).string();
  }

 private:
  test::TempDir dir_;
};

TEST_F(FinishedPicture, IsWhatWriteImageLeaves) {
  for (const std::string extension :
       {"exr", "hdr", "png", "jpg", "tif", "webp", "ppm", "bmp", "tga"}) {
    const std::string path = at("a." + extension);
    EXPECT_FALSE(is_finished_picture(path, {40, 30, {}})) << extension;
    ASSERT_TRUE(write_image(test::noise(40, 30), path)) << extension;
    EXPECT_TRUE(is_finished_picture(path, {40, 30, {}})) << extension;
    EXPECT_FALSE(is_finished_picture(path, {30, 40, {}})) << extension;
    EXPECT_FALSE(is_finished_picture(path, {-1, INT_MAX, {INT_MIN, -1, 0, 0}})) << extension;
    const std::string whole = test::read_bytes(path);
    test::write_bytes(path, whole.substr(0, whole.size() / 2));
    EXPECT_FALSE(is_finished_picture(path, {40, 30, {}})) << extension << ", half of it";
  }
}

TEST_F(FinishedPicture, HasTheChannelsThatAreAskedFor) {
  ImageFileOptions options;
  options.channels = {{"Z", std::vector<float>(12)}};
  ASSERT_TRUE(write_image(test::noise(4, 3), at("a.exr"), options));
  EXPECT_TRUE(is_finished_picture(at("a.exr"), {4, 3, {}, {"Z"}}));
  EXPECT_FALSE(is_finished_picture(at("a.exr"), {4, 3, {}, {}}));
  EXPECT_FALSE(is_finished_picture(at("a.exr"), {4, 3, {}, {"Z", "id"}}));
}

/// A TGA file whose header declares no rows.
TEST_F(FinishedPicture, HasPixels) {
  ASSERT_TRUE(write_image(test::noise(4, 3), at("a.tga")));
  std::string bytes = test::read_bytes(at("a.tga"));
  ASSERT_EQ(bytes[14], 3);
  bytes[14] = 0;
  test::write_bytes(at("a.tga"), bytes);
  EXPECT_FALSE(is_finished_picture(at("a.tga"), {4, 0, {}}));
}

long most_mebibytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss / 1024;
}

/// A BMP file whose header declares 728 million by 3 pixels, and which ends there.
TEST_F(FinishedPicture, IsRefusedByAnotherSize) {
  ASSERT_TRUE(write_image(test::noise(4, 3), at("small.bmp")));
  ASSERT_TRUE(is_finished_picture(at("small.bmp"), {4, 3, {}}));
  std::string bytes = test::read_bytes(at("small.bmp")).substr(0, 54);
  bytes.replace(18, 8, std::string("\x04\x73\x63\x2b\x03\0\0\0", 8));
  test::write_bytes(at("wide.bmp"), bytes);
  const long before = most_mebibytes();
  EXPECT_FALSE(is_finished_picture(at("wide.bmp"), {4, 3, {}}));
  EXPECT_LT(most_mebibytes() - before, 100);
}

}  // namespace
}  // namespace boule
