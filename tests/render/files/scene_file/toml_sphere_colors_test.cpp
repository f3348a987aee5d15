// Colours of the spheres of a .npy file: from a file of colours, or of numbers with a colour map.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/math/srgb.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/npy_files.h"

namespace boule {
namespace {

template <class Number>
std::string npy_of(const std::string& descr, const std::string& shape,
                   const std::vector<Number>& numbers) {
  std::string data;
  for (const Number& number : numbers) test::append_bytes(data, number);
  return test::npy_file(test::npy_dict(descr, shape), data);
}

/// A folder with "two.npy", two spheres, and "many.npy", 201 of them.
class SphereColorsTest : public testing::Test {
 protected:
  SphereColorsTest() {
    write("two.npy", test::sphere_file({{{0, 0, 0}, 1, 0}, {{3, 0, 0}, 1, 0}}));
    std::vector<Sphere> many;
    for (int i = 0; i < 201; ++i) many.push_back({{static_cast<float>(i), 0, 0}, 1, 0});
    write("many.npy", test::sphere_file(many));
  }

  void write(const std::string& name, const std::string& bytes) {
    static_cast<void>(files_.write(name, bytes));
  }
  [[nodiscard]] Result<LoadedScene> load(const std::string& keys, const char* file = "two.npy",
                                         const SceneFileOptions& options = {}) const {
    return files_.load("scene.toml",
                       "schema = 1\n[material.m]\n[material.shiny]\ntype = \"plastic\"\n"
                       "[[spheres]]\nfile = \"" +
                           std::string(file) + "\"\nmaterial = \"shiny\"\n" + keys,
                       options);
  }
  void expect_colors(const std::string& keys, SrgbColor first, SrgbColor second) const {
    const auto loaded = load(keys);
    ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
    const auto& spheres = loaded.value().scene.spheres;
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(hex_text(spheres[0].material.color()), hex_text(first));
    EXPECT_EQ(hex_text(spheres[1].material.color()), hex_text(second));
    EXPECT_EQ(spheres[0].material.index(), 1u);
  }
  /// Expects an error in line 8, the first of the keys.
  void expect_refused(const std::string& keys, const char* key, const std::string& words) const {
    const auto loaded = load(keys);
    ASSERT_FALSE(loaded.ok()) << keys;
    EXPECT_EQ(loaded.error().key, std::string("spheres[0].") + key);
    EXPECT_EQ(loaded.error().line, 8);
    EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
  }

  test::SceneFolder files_;
};

TEST_F(SphereColorsTest, ComeFromBytes) {
  write("c.npy", npy_of<std::uint8_t>("'|u1'", "(2, 3)", {1, 2, 3, 255, 128, 0}));
  expect_colors("colors = \"c.npy\"\n", {1, 2, 3}, {255, 128, 0});
  expect_colors("colors = \"c.npy\"\ncolor_space = \"srgb\"\n", {1, 2, 3}, {255, 128, 0});
}

TEST_F(SphereColorsTest, ComeFromFloats) {
  write("f.npy", npy_of<float>("'<f4'", "(2, 3)", {0, 0.5F, 1, 1.0F / 255, 0.2F, 0.25F}));
  expect_colors("colors = \"f.npy\"\n", {0, 128, 255}, {1, 51, 64});
  write("d.npy", npy_of<double>("'<f8'", "(2, 3)", {0, 0.5, 1, 0.2, 0.25, 0.001}));
  const auto code = [](float linear) { return SrgbTable::get().code(linear); };
  expect_colors("colors = \"d.npy\"\ncolor_space = \"linear\"\n", {0, code(0.5F), 255},
                {code(0.2F), code(0.25F), code(0.001F)});
}

TEST_F(SphereColorsTest, ComeFromNumbersAndAMap) {
  write("v.npy", npy_of<double>("'<f8'", "(2,)", {-1, 2}));
  const ColorMap viridis;
  const std::string keys = "scalar = \"v.npy\"\nrange = [-2, 2]\n";
  expect_colors(keys, viridis.color(0.25), viridis.color(1));
  expect_colors(keys + "map = \"grey\"\n", ColorMap(NamedColorMap::grey).color(0.25),
                ColorMap(NamedColorMap::grey).color(1));
  expect_colors(keys + "map = [\"#000000\", \"#c86432\"]\n", {50, 25, 13}, {200, 100, 50});
  write("i.npy", npy_of<std::int64_t>("'<i8'", "(2, 1)", {-1, 7}));
  expect_colors("scalar = \"i.npy\"\nrange = [-2, 2]\n", viridis.color(0.25), viridis.color(1));
}

TEST_F(SphereColorsTest, HaveTheRangeOfMostNumbers) {
  std::vector<float> numbers;
  for (int i = 0; i <= 200; ++i) numbers.push_back(static_cast<float>(200 - i));
  numbers[0] = 1e9F;  // beyond the 99th percentile
  write("many_v.npy", npy_of("'<f4'", "(201,)", numbers));
  const auto loaded = load("scalar = \"many_v.npy\"\n", "many.npy");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  const auto& facts = loaded.value().particles;
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].table, "spheres[0]");
  EXPECT_EQ(facts[0].file, files_.path("many.npy"));
  EXPECT_EQ(facts[0].spheres, 201u);
  ASSERT_TRUE(facts[0].colors.scale);
  EXPECT_EQ(facts[0].colors.scale->by, "many_v.npy");
  EXPECT_EQ(facts[0].colors.scale->range, (std::array<double, 2>{2, 198}));
  EXPECT_THAT(loaded.value().data_files,
              testing::ElementsAre(files_.path("many.npy"), files_.path("many_v.npy")));
  EXPECT_THAT(loaded.value().notes,
              testing::ElementsAre(testing::HasSubstr("'many_v.npy' go from 2 to 198")));
  // Another frame has the same range.
  SceneFileOptions options;
  options.choices["spheres[0]"] = facts[0].own;
  options.choices["spheres[0]"].finish("all 2 frames");
  write("v.npy", npy_of<float>("'<f4'", "(2,)", {100, 1000}));
  const auto next = load("scalar = \"v.npy\"\n", "two.npy", options);
  ASSERT_TRUE(next.ok());
  EXPECT_THAT(next.value().notes, testing::ElementsAre(testing::HasSubstr("of all 2 frames")));
  EXPECT_EQ(next.value().scene.spheres[0].material.color(), ColorMap().color(0.5));
}

TEST_F(SphereColorsTest, OneNumberHasAColorToo) {
  write("v.npy", npy_of<float>("'<f4'", "(2,)", {3, 3}));
  const auto loaded = load("scalar = \"v.npy\"\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  const auto& spheres = loaded.value().scene.spheres;
  EXPECT_TRUE(spheres[0].material.has_color());
  EXPECT_EQ(spheres[0].material, spheres[1].material);
}

TEST_F(SphereColorsTest, WrongFilesAreRefused) {
  write("c.npy", npy_of<std::uint8_t>("'|u1'", "(2, 3)", {1, 2, 3, 255, 128, 0}));
  write("three.npy", npy_of<float>("'<f4'", "(3, 3)", {0, 0, 0, 0, 0, 0, 0, 0, 0}));
  write("four.npy", npy_of<float>("'<f4'", "(2, 4)", {0, 0, 0, 0, 0, 0, 0, 0}));
  write("large.npy", npy_of<float>("'<f4'", "(2, 3)", {0, 0, 0, 0, 1.5F, 0}));
  write("nan.npy", npy_of<float>("'<f4'", "(2, 3)", {0, 0, 0, 0, std::nanf(""), 0}));
  write("short.npy", npy_of<float>("'<f4'", "(2, 3)", {0, 0, 0, 0, 0}));
  write("whole.npy", npy_of<std::int32_t>("'<i4'", "(2, 3)", {0, 0, 0, 0, 0, 0}));
  write("complex.npy", npy_of<double>("'<c16'", "(2, 3)", {0, 0, 0, 0, 0, 0}));
  write("inf.npy", npy_of<float>("'<f4'", "(2,)", {0, INFINITY}));
  const auto colors = [](const char* name) { return "colors = \"" + std::string(name) + "\"\n"; };
  expect_refused(colors("missing.npy"), "colors", "No such file");
  expect_refused(colors("three.npy"), "colors", "has shape (3, 3), expected (2, 3)");
  expect_refused(colors("four.npy"), "colors", "expected (2, 3)");
  expect_refused(colors("large.npy"), "colors", "row 1: must be from 0 to 1, is 1.5");
  expect_refused(colors("nan.npy"), "colors", "row 1: must be from 0 to 1");
  expect_refused(colors("short.npy"), "colors", "bytes");
  expect_refused(colors("whole.npy"), "colors", "holds whole numbers");
  expect_refused(colors("complex.npy"), "colors", "holds '<c16'");
  expect_refused("colors = \"c.npy\"\ncolor_space = \"linear\"\n", "colors", "uint8");
  expect_refused("scalar = \"c.npy\"\n", "scalar", "has shape (2, 3), expected (2,)");
  expect_refused("scalar = \"inf.npy\"\n", "scalar", "row 1: must be finite");
}

TEST_F(SphereColorsTest, WrongKeysAreRefused) {
  expect_refused("color_space = \"srgb\"\n", "color_space", "goes with 'colors'");
  expect_refused("color_space = \"rgb\"\ncolors = \"c.npy\"\n", "color_space", "unknown 'rgb'");
  expect_refused("map = \"magma\"\n", "map", "goes with 'scalar'");
  expect_refused("range = [0, 1]\n", "range", "goes with 'scalar'");
  expect_refused("scalar = \"v.npy\"\ncolors = \"c.npy\"\n", "scalar", "beside 'colors'");
  expect_refused("colors = \"c.npy\"\ncolor = \"#102030\"\n", "colors", "beside 'color'");
  expect_refused("map = \"viridi\"\nscalar = \"v.npy\"\n", "map", "did you mean 'viridis'");
  expect_refused("map = [\"#000000\", \"rde\"]\nscalar = \"v.npy\"\n", "map", "'rde' is no colour");
  expect_refused("map = []\nscalar = \"v.npy\"\n", "map", "expected");
  expect_refused("range = [1, 1]\nscalar = \"v.npy\"\n", "range", "below the second");
  expect_refused("range = [0, inf]\nscalar = \"v.npy\"\n", "range", "finite");
  expect_refused("range = 1\nscalar = \"v.npy\"\n", "range", "an array of 2 numbers");
  expect_refused("colors = \"\"\n", "colors", "expected the name");
}

}  // namespace
}  // namespace boule
