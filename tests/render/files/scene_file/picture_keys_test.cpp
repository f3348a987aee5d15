// Pictures that a scene file names: ST maps, environments.
#include "render/image/write_image.h"
#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

#include <limits>

namespace boule::test {
namespace {

class Pictures : public testing::Test {
 protected:
  explicit Pictures(const char* begin) : begin_(begin) {}

  [[nodiscard]] std::string scene(const std::string& keys) const { return begin_ + keys; }
  void write(const Image& image, const std::string& name) const {
    const Status done = write_image(image, files_.path(name));
    ASSERT_TRUE(done) << done.error().message;
  }
  void expect_refused(const std::string& keys, int line, int column, const std::string& key,
                      const std::string& words) const {
    const auto loaded = files_.load("scene.toml", scene(keys));
    ASSERT_FALSE(loaded) << keys;
    EXPECT_EQ(loaded.error().line, line);
    EXPECT_EQ(loaded.error().column, column);
    EXPECT_EQ(loaded.error().key, key);
    EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
  }

  /// What is wrong with the file of any picture, its key, or its name: the table begins in line
  /// `table`, its keys in line `line`.
  void expect_files_refused(const std::string& path, int table, int line) const {
    const std::string key = path + ".file";
    expect_refused("", table, 1, key, "missing key 'file'");
    expect_refused("fiel = \"a\"\n", line, 1, path + ".fiel", "did you mean 'file'?");
    expect_refused("file = 1\n", line, 8, key, "expected a string");
    expect_refused("file = \"none.exr\"\n", line, 8, key,
                   "'none.exr': cannot read it: No such file");
    expect_refused("file = \".\"\n", line, 8, key, "it is a directory");
    expect_refused("file = \"scene.toml\"\n", line, 8, key,
                   "unknown extension, expected one of exr");
    files_.write("text.exr", "no picture").size();
    expect_refused("file = \"text.exr\"\n", line, 8, key, "'text.exr': cannot read it: ");
  }

  SceneFolder files_;

 private:
  std::string begin_;
};

class Distortion : public Pictures {
 protected:
  Distortion()
      : Pictures(
            "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n[camera.distortion]\n") {}
};

class Environment : public Pictures {
 protected:
  Environment() : Pictures("schema = 1\n[background]\ntype = \"environment\"\n") {}
};

Image small_map() {
  Image image(3, 2);
  image.pixels = {{0.1f, 0.9f, 7},  {0.5f, 0.8f, 7}, {1.2f, 0.7f, 7},
                  {-0.1f, 0.3f, 7}, {0.4f, 0.2f, 7}, {0.9f, 0.1f, 7}};
  return image;
}

TEST_F(Distortion, IsRedAndGreenOfThePicture) {
  write(small_map(), "map.exr");
  const auto loaded = files_.load("scene.toml", scene("file = \"map.exr\"\n"));
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  const auto& map = loaded.value().scene.distortion;
  ASSERT_TRUE(map);
  EXPECT_EQ(map->width, 3);
  EXPECT_EQ(map->height, 2);
  EXPECT_EQ(map->st, (std::vector<float>{0.1f, 0.9f, 0.5f, 0.8f, 1.2f, 0.7f,  //
                                         -0.1f, 0.3f, 0.4f, 0.2f, 0.9f, 0.1f}));
}

TEST_F(Distortion, CodesAreNumbersFromZeroToOne) {
  write(Image(2, 2), "black.png");
  const auto loaded = files_.load("scene.toml", scene("file = \"black.png\"\n"));
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  EXPECT_EQ(loaded.value().scene.distortion->st, std::vector<float>(8, 0));
}

TEST_F(Distortion, IsRefusedWithPlaceAndKey) {
  const std::string key = "camera.distortion.file";
  expect_files_refused("camera.distortion", 5, 6);
  write(Image(1, 4), "narrow.exr");
  expect_refused("file = \"narrow.exr\"\n", 6, 8, key, "2 x 2 pixels or more, has 1 x 4");
  Image holes = small_map();
  holes.pixels[4].g = std::numeric_limits<float>::quiet_NaN();
  write(holes, "holes.exr");
  expect_refused("file = \"holes.exr\"\n", 6, 8, key, "must be finite");
}

TEST_F(Distortion, NonFiniteBlueDoesNotMatter) {
  Image image = small_map();
  image.pixels[0].b = std::numeric_limits<float>::infinity();
  write(image, "map.exr");
  EXPECT_TRUE(files_.load("scene.toml", scene("file = \"map.exr\"\n")));
}

TEST_F(Environment, IsThePictureAsItIs) {
  Image image = small_map();
  image.pixels[3].r = 3e38f;
  write(image, "sky.exr");
  const auto sky = files_.load("scene.toml", scene("file = \"sky.exr\"\nrotation = -400\n"));
  ASSERT_TRUE(sky) << format_diagnostic(sky.error());
  const auto& read = std::get<EnvironmentBackground>(sky.value().scene.background);
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  EXPECT_EQ(read.pixels, image.pixels);
  EXPECT_EQ(read.rotation, -400);
}

/// Codes of 8 bits are colours as screens show them; one pixel is enough.
TEST_F(Environment, CodesAreMadeLinear) {
  Image image(1, 1);
  image.pixels[0] = {1, 0.2158605f, 0};
  write(image, "wall.png");
  const auto loaded = files_.load("scene.toml", scene("file = \"wall.png\"\n"));
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  const Color c = std::get<EnvironmentBackground>(loaded.value().scene.background).pixels.at(0);
  EXPECT_EQ(c.r, 1);
  EXPECT_NEAR(c.g, 0.2158605, 1e-4);
  EXPECT_EQ(c.b, 0);
}

TEST_F(Environment, IsRefusedWithPlaceAndKey) {
  const std::string key = "background.file";
  expect_files_refused("background", 2, 4);
  write(small_map(), "dark.exr");
  expect_refused("file = \"dark.exr\"\n", 4, 8, key, "'dark.exr': must have finite numbers of 0");
  Image holes(2, 2);
  holes.pixels[3].b = std::numeric_limits<float>::quiet_NaN();
  write(holes, "holes.exr");
  expect_refused("file = \"holes.exr\"\n", 4, 8, key, "must have finite numbers");
  write(Image(2, 2), "black.exr");
  for (const char* angle : {"inf", "nan"}) {
    expect_refused(std::string("file = \"black.exr\"\nrotation = ") + angle + "\n", 5, 12,
                   "background.rotation", "must be finite");
  }
}

}  // namespace
}  // namespace boule::test
