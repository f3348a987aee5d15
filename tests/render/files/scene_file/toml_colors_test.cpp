// Colours of scene files: "#rrggbb", and colours of objects.
#include "core/math/srgb.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/npy_files.h"

namespace boule {
namespace {

Scene load(const std::string& text) {
  const test::SceneFolder files;
  auto loaded = files.load("scene.toml", "schema = 1\n" + text);
  EXPECT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  return loaded.ok() ? std::move(loaded).value().scene : Scene{};
}

TEST(TomlColors, MayBeWrittenInHex) {
  const Scene scene = load(
      "[background]\ncolor = \"#000000\"\nambient = \"#ffffff\"\n"
      "[material.red]\ncolor = \"#C04040\"\n[material.named]\ncolor = \"Crimson\"\n"
      "[[light]]\nposition = [1, 2, 3]\nintensity = \"#ffbc00\"\n");
  EXPECT_EQ(std::get<Matte>(scene.materials[0].material).color, linear_of({0xc0, 0x40, 0x40}));
  EXPECT_EQ(std::get<Matte>(scene.materials[1].material).color, linear_of({0xdc, 0x14, 0x3c}));
  EXPECT_EQ(std::get<PointLight>(scene.lights[0]).intensity, linear_of({0xff, 0xbc, 0}));
  EXPECT_EQ(scene.ambient, gray(1));
}

TEST(TomlColors, CodesReadAsLinearGetANote) {
  const test::SceneFolder files;
  const auto loaded = files.load("scene.toml",
                                 "schema = 1\n[material.red]\ncolor = [255, 0, 16]\n"
                                 "[material.lit]\ncolor = [1, 0, 1]\n"
                                 "[material.bright]\ncolor = [1.5, 2, 3]\n"
                                 "[material.brighter]\ncolor = [256, 0, 0]\n"
                                 "[[light]]\nintensity = [20, 20, 20]\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  EXPECT_THAT(loaded.value().notes,
              testing::ElementsAre("material.red.color: colours are linear and 1 is white; codes "
                                   "up to 255 are written \"#ff0010\""));
}

TEST(TomlColors, ObjectsHaveColorsOfTheirOwn) {
  const Scene scene = load(
      "[material.shiny]\ntype = \"plastic\"\n"
      "[[sphere]]\nmaterial = \"shiny\"\ncolor = \"#102030\"\n"
      "[[sphere]]\nmaterial = \"shiny\"\n"
      "[[sphere]]\ncolor = [1, 0.5028865, 0]\n"
      "[[plane]]\ncolor = \"#405060\"\n");
  EXPECT_EQ(scene.spheres[0].material, MaterialRef::colored(0, {0x10, 0x20, 0x30}));
  EXPECT_EQ(scene.spheres[1].material, MaterialRef(0));
  EXPECT_EQ(scene.spheres[2].material, MaterialRef::colored(1, {255, 188, 0}));
  EXPECT_EQ(scene.planes[0].material, MaterialRef::colored(2, {0x40, 0x50, 0x60}));
}

TEST(TomlColors, TheSpheresOfAFileHaveOne) {
  const test::SceneFolder files;
  static_cast<void>(
      files.write("two.npy", test::sphere_file({{{0, 0, 0}, 1, 0}, {{3, 0, 0}, 1, 0}})));
  const auto loaded = files.load(
      "scene.toml", "schema = 1\n[[spheres]]\nfile = \"two.npy\"\ncolor = \"#112233\"\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  for (const Sphere& sphere : loaded.value().scene.spheres) {
    EXPECT_EQ(sphere.material, MaterialRef::colored(0, {0x11, 0x22, 0x33}));
  }
}

TEST(TomlColors, WrongOnesAreRefusedWithTheirPlace) {
  const auto expect = [](const std::string& table, const std::string& value, const char* key,
                         const char* words) {
    const test::SceneFolder files;
    const auto loaded =
        files.load("scene.toml", "schema = 1\n" + table + "\ncolor = " + value + "\n");
    ASSERT_FALSE(loaded.ok()) << value;
    EXPECT_EQ(loaded.error().key, key);
    EXPECT_EQ(loaded.error().line, 3);
    EXPECT_EQ(loaded.error().column, 9);
    EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
  };
  expect("[material.m]", "\"c04040\"", "material.m.color", "expected \"#rrggbb\"");
  expect("[material.m]", "\"#c0404\"", "material.m.color", "expected \"#rrggbb\"");
  expect("[material.m]", "\"rde\"", "material.m.color", "; did you mean 'red'?");
  expect("[[sphere]]", "[1.5, 0, 0]", "sphere[0].color", "from 0 to 1");
  expect("[[sphere]]", "[-0.5, 0, 0]", "sphere[0].color", "from 0 to 1");
  expect("[[plane]]", "\"#12345\"", "plane[0].color", "expected \"#rrggbb\"");
  expect("[[sphere]]", "[1, 1]", "sphere[0].color", "an array of 3 numbers");
}

TEST(TomlColors, OnlyFirstMaterialsTakeColors) {
  std::string text;
  for (int i = 0; i < 129; ++i) text += "[material.m" + std::to_string(i) + "]\n";
  const Scene scene = load(text + "[[sphere]]\nmaterial = \"m127\"\ncolor = \"#010203\"\n");
  EXPECT_EQ(scene.spheres[0].material, MaterialRef::colored(127, {1, 2, 3}));
  const test::SceneFolder files;
  const auto loaded =
      files.load("scene.toml",
                 "schema = 1\n" + text + "[[sphere]]\nmaterial = \"m128\"\ncolor = \"#010203\"\n");
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().key, "sphere[0].color");
  EXPECT_THAT(loaded.error().message, testing::HasSubstr("first 128"));
}

}  // namespace
}  // namespace boule
