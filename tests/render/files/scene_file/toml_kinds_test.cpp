// The keys of [[particles]] that give colours and radii to kinds.
#include <string>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule {
namespace {

using testing::HasSubstr;

class TomlKindsTest : public testing::Test {
 protected:
  [[nodiscard]] Result<LoadedScene> load(const std::string& keys) const {
    static_cast<void>(files_.write("salt.xyz", "2\n\nNa 0 0 0\nCl 2 0 0\n"));
    return files_.load("scene.toml", "schema = 1\n[[particles]]\nfile = \"salt.xyz\"\n" + keys);
  }

  test::SceneFolder files_;
};

TEST_F(TomlKindsTest, HaveTheirColorsAndRadii) {
  const auto loaded = load(
      "colors = { Na = \"crimson\", cl = [0, 0, 1] }\n"
      "radii = { Na = 1.02 }\n"
      "radius = \"Covalent\"\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  const auto& spheres = loaded.value().scene.spheres;
  EXPECT_EQ(hex_text(spheres[0].material.color()), "#dc143c");
  EXPECT_EQ(hex_text(spheres[1].material.color()), "#0000ff");
  EXPECT_EQ(spheres[0].radius, 1.02F);
  EXPECT_EQ(spheres[1].radius, 1.02F);  // Cordero's
}

TEST_F(TomlKindsTest, BondsAreCapsules) {
  const auto loaded = load("bonds = 1e3\nbond_radius = 0.125\nbond_color = \"red\"\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  const Scene& scene = loaded.value().scene;
  ASSERT_FALSE(scene.capsules.empty());
  EXPECT_EQ(scene.capsules[0].a, scene.spheres[0].center);
  EXPECT_EQ(scene.capsules[0].b, scene.spheres[1].center);
  EXPECT_EQ(scene.capsules[0].radius, 0.125F);
  EXPECT_EQ(hex_text(scene.capsules[0].material.color()), "#ff0000");
  EXPECT_EQ(loaded.value().particles[0].bonds, scene.capsules.size());
}

TEST_F(TomlKindsTest, RefuseWhatIsWrong) {
  struct Wrong {
    const char *keys, *key, *words;
  };
  for (const Wrong& wrong :
       {Wrong{"colors = { Na = \"rde\" }\n", "colors.Na", "did you mean 'red'?"},
        Wrong{"colors = { Xx = \"red\" }\n", "colors", "no particle is of the kind 'Xx'"},
        Wrong{"colors = \"red\"\n", "colors", "expected a table"},
        Wrong{"nan_color = \"rde\"\n", "nan_color", "did you mean 'red'?"},
        Wrong{"style = \"stick\"\n", "style", "did you mean 'sticks'?"},
        Wrong{"bonds = \"distanse\"\n", "bonds", "did you mean 'distance'?"},
        Wrong{"bonds = 0\n", "bonds", "above 0, is 0"},
        Wrong{"bonds = \"file\"\n", "bonds", "the file lists no bonds"},
        Wrong{"bond_radius = -1\n", "bond_radius", "above 0, is -1"},
        Wrong{"bond_color = \"rde\"\n", "bond_color", "did you mean 'red'?"},
        Wrong{"cell_edges = true\n", "cell_edges", "the file tells no cell"},
        Wrong{"arrows = [\"fx\", \"fy\"]\n", "arrows", "expected three columns"},
        Wrong{"arrows = \"f\"\n", "arrows", "there is no column 'fx'"},
        Wrong{"outline_by = \"\"\n", "outline_by", "expected a column or 'object'"},
        Wrong{"outline_by = \"chains\"\n", "outline_by", "did you mean 'chain'?"},
        Wrong{"arrow_scale = 2\n", "arrow_scale", "needs the vectors of arrows"},
        Wrong{"radii = { Na = 0 }\n", "radii.Na", "above 0, is 0"},
        Wrong{"radii = { Na = \"big\" }\n", "radii.Na", "expected a number"}}) {
    const auto loaded = load(wrong.keys);
    ASSERT_FALSE(loaded.ok()) << wrong.keys;
    EXPECT_EQ(loaded.error().key, std::string("particles[0].") + wrong.key);
    EXPECT_EQ(loaded.error().line, 4);
    EXPECT_THAT(loaded.error().message, HasSubstr(wrong.words));
  }
}

}  // namespace
}  // namespace boule
