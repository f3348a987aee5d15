// Capsules in TOML files: one by one, many at once from .npy files and from memory, in groups.
#include "core/scene/instances.h"
#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/npy_files.h"

namespace boule::toml_capsules {
namespace {

using test::SceneFolder;

template <class Number>
std::string rows(const std::string& shape, const std::vector<Number>& numbers) {
  std::string data;
  for (const Number number : numbers) test::append_bytes(data, number);
  return test::npy_file(test::npy_dict(sizeof(Number) == 4 ? "'<f4'" : "'<f8'", shape), data);
}

/// Loads a scene beside the file rods.npy.
Result<LoadedScene> load_beside(const std::string& rods, const std::string& text) {
  const SceneFolder files;
  EXPECT_FALSE(files.write("rods.npy", rods).empty());
  EXPECT_FALSE(files.write("red.npy", rows<float>("(2, 3)", {1, 0, 0, 0, 0, 1})).empty());
  return files.load("scene.toml", "schema = 1\n" + text);
}

TEST(TomlCapsules, AreReadInFileOrder) {
  const auto loaded = load_beside(rows<float>("(2, 7)", {0, 0, 0, 1, 0, 0, 0.5F,  //
                                                         0, 1, 0, 1, 1, 1, 0.25F}),
                                  R"([material.blue]
color = "#0000ff"
[[capsule]]
a = [1, 2, 3]
b = [4, 5, 6]
radius = 0.125
color = "#ff0000"
[[capsules]]
file = "rods.npy"
material = "blue"
[[capsule]]
[[sphere]]
)");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.capsules.size(), 4U);
  EXPECT_EQ(scene.capsules[0].a, (Vec3f{1, 2, 3}));
  EXPECT_EQ(scene.capsules[0].b, (Vec3f{4, 5, 6}));
  EXPECT_EQ(scene.capsules[0].radius, 0.125F);
  EXPECT_TRUE(scene.capsules[0].material.has_color());
  EXPECT_EQ(scene.materials[scene.capsules[0].material.index()].name, "default");
  EXPECT_EQ(scene.capsules[2].a, (Vec3f{0, 1, 0}));
  EXPECT_EQ(scene.capsules[2].b, (Vec3f{1, 1, 1}));
  EXPECT_EQ(scene.capsules[2].radius, 0.25F);
  EXPECT_EQ(scene.materials[scene.capsules[1].material.index()].name, "blue");
  EXPECT_EQ(scene.capsules[3].radius, 1);
  EXPECT_EQ(scene.capsules[3].b, Vec3f{});
}

TEST(TomlCapsules, HaveColorsOfTheirOwn) {
  const auto loaded =
      load_beside(rows<double>("(2, 6)", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}),
                  "[[capsules]]\nfile = \"rods.npy\"\nradius = 0.5\ncolors = \"red.npy\"\n");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  const auto& capsules = loaded.value().scene.capsules;
  ASSERT_EQ(capsules.size(), 2U);
  EXPECT_EQ(capsules[0].material.color(), (SrgbColor{255, 0, 0}));
  EXPECT_EQ(capsules[1].material.color(), (SrgbColor{0, 0, 255}));
  EXPECT_EQ(capsules[1].radius, 0.5F);
}

TEST(TomlCapsules, StandInGroups) {
  const auto loaded = load_beside(rows<float>("(1, 7)", {0, 0, 0, 1, 0, 0, 0.5F}), R"(
[[group.rod.capsules]]
file = "rods.npy"
[[group.rod.capsule]]
a = [0, 1, 0]
[[instance]]
group = "rod"
rotate = [0, 0, 90]
scale = 2
translate = [5, 0, 0]
)");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  Scene scene = loaded.value().scene;
  EXPECT_EQ(scene.groups.at(0).capsules.size(), 2U);
  expand_instances(scene);
  ASSERT_EQ(scene.capsules.size(), 2U);
  EXPECT_EQ(scene.capsules[0].a, (Vec3f{5, 0, 0}));
  EXPECT_EQ(scene.capsules[0].b, (Vec3f{5, 2, 0}));
  EXPECT_EQ(scene.capsules[0].radius, 1);
  EXPECT_EQ(scene.capsules[1].radius, 2);
}

/// Ends a million away are counted from a point among them, and keep their digits.
TEST(TomlCapsules, FarOnesAreCountedFromAnOrigin) {
  const double far = 1e6;
  const auto loaded =
      load_beside(rows<double>("(1, 7)", {far + 0.001, 0, 0, far + 1, 0.3, 0, 0.01}),
                  "[[capsules]]\nfile = \"rods.npy\"\n[[capsule]]\na = [1000000.5, 0, 0]\n"
                  "b = [1000000.7, 0, 0]\nradius = 0.01\n");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  EXPECT_EQ(loaded.value().origin, (Vec3d{far, 0, 0}));
  const auto& capsules = loaded.value().scene.capsules;
  EXPECT_NEAR(capsules.at(0).a.x, 0.001, 1e-9);
  EXPECT_NEAR(capsules.at(1).b.x, 0.7, 1e-7);
  const SceneFolder files;
  const auto one = files.load("one.toml",
                              "schema = 1\n[[capsule]]\na = [1000000.5, 0, 0]\n"
                              "b = [1000000.7, 0, 0]\nradius = 0.01\n");
  ASSERT_TRUE(one);
  EXPECT_NE(one.value().origin, Vec3d{});
}

TEST(TomlCapsules, BadRowsAreNamed) {
  struct Case {
    std::vector<float> numbers;
    std::string shape, keys, told;
  };
  const float nan = NAN;
  const std::vector<Case> cases{
      {{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1}, "(2, 7)", "", "row 1: radius must be"},
      {{0, 0, 0, 1, nan, 0, 1}, "(1, 7)", "", "row 0: b must be finite"},
      {{0, 0, 0, 1, 0, 0}, "(1, 6)", "", "has 6 columns: the key 'radius' is missing"},
      {{0, 0, 0, 1, 0, 0, 1}, "(1, 7)", "radius = 1\n", "has radii of its own in column 6"},
      {{0, 0, 0, 1}, "(1, 4)", "", "has shape (1, 4), expected (N, 7), or (N, 6) and `radius`"},
      {{0, 0, 0, 1, 0, 0, 1},
       "(1, 7)",
       "colors = \"red.npy\"\n",
       "has shape (2, 3), expected (1, 3): a row for each capsule"},
      {{0, 0, 0, 1, 0, 0, 1},
       "(1, 7)",
       "radii = 1\n",
       "unknown key 'radii', expected 'file', 'radius'"},
  };
  for (const Case& one : cases) {
    const auto loaded = load_beside(rows<float>(one.shape, one.numbers),
                                    "[[capsules]]\nfile = \"rods.npy\"\n" + one.keys);
    ASSERT_FALSE(loaded) << one.told;
    EXPECT_NE(loaded.error().message.find(one.told), std::string::npos)
        << format_diagnostic(loaded.error());
    EXPECT_TRUE(loaded.error().key.starts_with("capsules[0]")) << loaded.error().key;
  }
  const SceneFolder files;
  const auto loaded =
      files.load("scene.toml", "schema = 1\n[[capsule]]\n[[capsule]]\nradius = 0\n");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().key, "capsule[1].radius");
  EXPECT_EQ(loaded.error().line, 4);
}

}  // namespace
}  // namespace boule::toml_capsules
