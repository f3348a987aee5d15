#include "core/scene/instances.h"
#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

// Groups in TOML files: what they say, and how wrong ones are refused.

namespace boule::toml_groups {
namespace {

using test::dump;
using test::Refusal;
using test::SceneFolder;

constexpr const char* forest = R"(schema = 1
[[instance]]
group = "pair"
translate = [1, 2, 3]
rotate = [10, 20, 30]
scale = 0.5
[[instance]]
group = "tree"
material = "red"
[[sphere]]
material = "red"
[group.tree]
[[group.tree.plane]]
point = [0, 1, 0]
[[group.tree.sphere]]
center = [0, 2, 0]
radius = 0.5
material = "red"
[[group.tree.sphere]]
[group.pair]
[[group.pair.instance]]
group = "tree"
[[group.pair.instance]]
group = "tree"
translate = [5, 0, 0]
[material.red]
color = [1, 0, 0]
)";

TEST(TomlGroups, HoldObjectsShownByInstances) {
  const auto loaded = SceneFolder{}.load("scene.toml", forest);
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  Scene scene = loaded.value().scene;
  ASSERT_EQ(scene.groups.size(), 2u);
  EXPECT_EQ(scene.groups[0].name, "tree");
  EXPECT_EQ(scene.groups[0].spheres.size(), 2u);
  EXPECT_EQ(scene.groups[0].planes.size(), 1u);
  EXPECT_EQ(scene.groups[1].instances.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 2u);
  const Instance& first = scene.instances[0];
  EXPECT_EQ(first.group, 1u);
  EXPECT_TRUE(first.translate == (Vec3f{1, 2, 3}) && first.rotate == (Vec3f{10, 20, 30}));
  EXPECT_EQ(first.scale, 0.5f);
  EXPECT_FALSE(first.material);
  EXPECT_EQ(scene.instances[1].material, 0u);
  expand_instances(scene);
  EXPECT_EQ(scene.spheres.size(), 1u + 4 + 2);
  EXPECT_EQ(scene.planes.size(), 2u + 1);
  EXPECT_EQ(scene.spheres[1].material, 0u);  // the tree's own
  EXPECT_EQ(scene.spheres[2].material, 1u);  // the default one
  EXPECT_EQ(scene.spheres[6].material, 0u);  // red in place of it
}

TEST(TomlGroups, NeedNoHeaderAndMayBeInline) {
  const auto loaded = SceneFolder{}.load("scene.toml", R"(schema = 1
instance = [{group = "a"}, {group = "a", scale = 2}]
[[group.a.sphere]]
radius = 3
)");
  ASSERT_TRUE(loaded) << format_diagnostic(loaded.error());
  EXPECT_EQ(count_primitives(loaded.value().scene).spheres, 2u);
}

class TomlGroupErrors : public testing::TestWithParam<Refusal> {};

TEST_P(TomlGroupErrors, AreRefusedWithPlaceAndKey) {
  test::expect_refused(GetParam(), "scene.toml");
}

std::string scene(const std::string& text) { return "schema = 1\n" + text; }
std::string instance(const std::string& text) {
  return scene("[[group.a.sphere]]\n[[instance]]\ngroup = \"a\"\n" + text);
}

const Refusal wrong[] = {
    {"UnknownGroup", instance("[[instance]]\ngroup = \"b\"\n"), 6, 9, "instance[1].group",
     "unknown group 'b'"},
    {"GroupSlip", scene("[group.bunny]\n[[instance]]\ngroup = \"buny\"\n"), 4, 9,
     "instance[0].group", "did you mean 'bunny'?"},
    {"NoGroup", scene("[[instance]]\n"), 2, 1, "instance[0].group", "missing key 'group'"},
    {"GroupType", scene("[[instance]]\ngroup = 1\n"), 3, 9, "instance[0].group", "a string"},
    {"ScaleZero", instance("scale = 0\n"), 5, 9, "instance[0].scale", "above 0, is 0"},
    {"ScaleNegative", instance("scale = -2\n"), 5, 9, "instance[0].scale", "above 0, is -2"},
    {"ScaleNan", instance("scale = nan\n"), 5, 9, "instance[0].scale", "finite"},
    {"ScaleArray", instance("scale = [1, 2, 1]\n"), 5, 9, "instance[0].scale", "a number"},
    {"TranslateTwo", instance("translate = [1, 2]\n"), 5, 13, "instance[0].translate", "got 2"},
    {"RotateInf", instance("rotate = [0, inf, 0]\n"), 5, 10, "instance[0].rotate", "finite"},
    {"UnknownKey", instance("scael = 1\n"), 5, 1, "instance[0].scael", "did you mean 'scale'?"},
    {"Material", instance("material = \"red\"\n"), 5, 12, "instance[0].material",
     "unknown material 'red'"},
    {"Overflow", instance("scale = 1e38\n[[group.a.sphere]]\nradius = 10\n"), 5, 9,
     "instance[0].scale", "out of a 32-bit float's range"},
    {"GroupKey", scene("[group.a]\ncolor = 1\n"), 3, 1, "group.a.color", "unknown key 'color'"},
    {"GroupLight", scene("[[group.a.light]]\n"), 2, 11, "group.a.light", "unknown key 'light'"},
    {"GroupNoTable", scene("[group]\na = 1\n"), 3, 5, "group.a", "expected a table"},
    {"SphereInGroup", scene("[group.a]\n[[group.a.sphere]]\nradius = -1\n"), 4, 10,
     "group.a.sphere[0].radius", "above 0"},
    {"SphereNoList", scene("[group.a.sphere]\n"), 2, 1, "group.a.sphere",
     "under a header [[group.a.sphere]]"},
    {"FileInGroup", scene("[[group.a.spheres]]\nfile = \"none.npy\"\n"), 3, 8,
     "group.a.spheres[0].file", "none.npy"},
    {"ItsOwnInstance", scene("[[group.a.instance]]\ngroup = \"a\"\n"), 3, 9,
     "group.a.instance[0].group", "makes a cycle: 'a' -> 'a'"},
    {"Cycle",
     scene("[[group.a.instance]]\ngroup = \"b\"\n[[group.b.instance]]\ngroup = \"c\"\n"
           "[[group.c.instance]]\ngroup = \"b\"\n"),
     7, 9, "group.c.instance[0].group", "makes a cycle: 'b' -> 'c' -> 'b'"},
};
INSTANTIATE_TEST_SUITE_P(Wrong, TomlGroupErrors, testing::ValuesIn(wrong), test::refusal_name);

TEST(TomlGroups, TooManySpheresNameTheirInstance) {
  std::string text = scene("[[group.g0.sphere]]\n");
  for (int i = 1; i <= 40; ++i) {
    const std::string header = "[[group.g" + std::to_string(i) + ".instance]]\ngroup = \"g" +
                               std::to_string(i - 1) + "\"\n";
    text += header + header;
  }
  text += "[[instance]]\ngroup = \"g5\"\n[[instance]]\ngroup = \"g40\"\n";
  test::expect_refused({"", text, 166, 9, "instance[1].group", "more than 2147483647"},
                       "scene.toml");
}

}  // namespace
}  // namespace boule::toml_groups
