// Ghosts in TOML files: a material, and particles.
#include "tests/render/files/scene_file/scene_folder.h"

namespace boule::toml_ghosts {
namespace {

using test::SceneFolder;
using testing::HasSubstr;

class TomlGhosts : public testing::Test {
 protected:
  TomlGhosts() { static_cast<void>(files_.write("a.xyz", "2\n\nC 0 0 0\nO 1 0 0\n")); }
  [[nodiscard]] Result<LoadedScene> load(const std::string& text) const {
    return files_.load("scene.toml", "schema = 1\n" + text, {});
  }
  [[nodiscard]] std::string error_of(const std::string& text) const {
    const auto loaded = load(text);
    return loaded ? "" : format_diagnostic(loaded.error());
  }

  SceneFolder files_;
};

TEST_F(TomlGhosts, AreAMaterialOfTheirOwn) {
  const auto loaded =
      load("[material.film]\ntype = \"ghost\"\ncolor = [0, 0.5, 1]\nopacity = 0.4\n");
  ASSERT_TRUE(loaded);
  const auto& film = std::get<Ghost>(loaded.value().scene.materials[0].material);
  EXPECT_EQ(film.color, (Color{0, 0.5F, 1}));
  EXPECT_EQ(film.opacity, 0.4F);
  EXPECT_THAT(error_of("[material.film]\ntype = \"ghost\"\nopacity = 2\n"),
              HasSubstr("must be from 0 to 1, is 2"));
  EXPECT_THAT(error_of("[material.film]\ntype = \"gohst\"\n"), HasSubstr("did you mean 'ghost'?"));
  EXPECT_THAT(error_of("[material.film]\ntype = \"ghost\"\nopacty = 0.1\n"),
              HasSubstr("did you mean 'opacity'?"));
}

TEST_F(TomlGhosts, OfParticlesHaveTheirColor) {
  const std::string table =
      "[material.red]\ncolor = [1, 0, 0]\n[[particles]]\nfile = \"a.xyz\"\nmaterial = \"red\"\n";
  const auto loaded = load(table + "ghost = \"species == 'O'\"\nopacity = 0.1\n");
  ASSERT_TRUE(loaded);
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.materials.size(), 2U);
  const auto& film = std::get<Ghost>(scene.materials[1].material);
  EXPECT_EQ(film.color, (Color{1, 0, 0}));
  EXPECT_EQ(film.opacity, 0.1F);
  EXPECT_EQ(scene.spheres[0].material.index(), 0U);
  EXPECT_EQ(scene.spheres[1].material.index(), 1U);
  EXPECT_THAT(error_of(table + "opacity = 0.1\n"), HasSubstr("needs the particles of ghost"));
  EXPECT_THAT(error_of(table + "ghost = \"x > 0\"\nopacity = -1\n"),
              HasSubstr("must be from 0 to 1, is -1 (key 'particles[0].opacity')"));
  EXPECT_THAT(error_of(table + "ghost = \"spcies == 'O'\"\n"),
              HasSubstr("did you mean 'species'?"));
}

}  // namespace
}  // namespace boule::toml_ghosts
