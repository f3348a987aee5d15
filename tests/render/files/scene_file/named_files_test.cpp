// Files that a scene names: lenses, and pictures of surroundings.
#include <utility>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule::named_files {
namespace {

using testing::HasSubstr;

/// pbrt's prescriptions have 0 as the index behind the stop.
TEST(NamedFiles, TheIndex0OfALensIsAir) {
  const test::SceneFolder files;
  static_cast<void>(files.write("a.lens", "50 5 1.5 20\n-50 2 1 20\n0 3 0 8\n"));
  const std::string text =
      "schema = 1\n[camera]\ntype = \"lens\"\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
      "file = \"a.lens\"\n";
  const auto loaded = files.load("scene.toml", text);
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  EXPECT_EQ(std::get<LensCamera>(*loaded.value().scene.camera).surfaces[2].index, 1);
}

TEST(NamedFiles, LensErrorsNameTheLensFilesLine) {
  const test::SceneFolder files;
  const auto expect = [&](const std::string& lens, int line, const std::string& words) {
    static_cast<void>(files.write("a.lens", lens));
    const auto loaded = files.load("scene.toml",
                                   "schema = 1\n[camera]\ntype = \"lens\"\neye = [0, 0, 5]\n"
                                   "look_at = [0, 0, 0]\nfile = \"a.lens\"\n");
    ASSERT_FALSE(loaded) << lens;
    EXPECT_EQ(loaded.error().file, files.path("a.lens"));
    EXPECT_EQ(loaded.error().line, line) << lens;
    EXPECT_EQ(loaded.error().key, "camera.file");
    EXPECT_THAT(loaded.error().message, HasSubstr(words));
  };
  expect("# two\n50 5 1.5 20\n\n-50 0 9 20\n", 4, "surface 2: its index must be from 0.25 to 8");
  expect("50 5 1.5 20\n-50 0 1 wide\n", 2, "expected four numbers");
  expect("50 5 1.5 0.01\n-50 0 1 20\n", 1, "surface 1: its aperture is less than a 500th");
  expect("# flat\n50 -5 1.5 20\n", 2, "surface 1: its thickness must be");
}

TEST(NamedFiles, APictureOfAnotherShapeIsNoted) {
  const test::SceneFolder files;
  const auto notes_of = [&](const std::string& size, std::size_t pixels) {
    static_cast<void>(
        files.write("sky.ppm", "P6 " + size + " 255\n" + std::string(3 * pixels, 'a')));
    const auto loaded = files.load(
        "scene.toml", "schema = 1\n[background]\ntype = \"environment\"\nfile = \"sky.ppm\"\n");
    EXPECT_TRUE(loaded) << size;
    return loaded ? loaded.value().notes : std::vector<std::string>{};
  };
  EXPECT_THAT(notes_of("4 4", 16),
              testing::ElementsAre(
                  "background.file: 'sky.ppm' has 4 x 4 pixels and is taken as latitude-longitude, "
                  "which is twice as wide as high: convert light probes and cube maps first"));
  EXPECT_EQ(notes_of("4 3", 12).size(), 1U);
  EXPECT_EQ(notes_of("8 1", 8).size(), 1U);
  for (const auto& [size, pixels] : {std::pair{"4 2", 8}, {"41 20", 820}, {"1 1", 1}})
    EXPECT_TRUE(notes_of(size, static_cast<std::size_t>(pixels)).empty()) << size;
}

}  // namespace
}  // namespace boule::named_files
