// Clip planes in TOML files, and in packed ones.
#include <gtest/gtest.h>

#include "render/files/packed/packed_contents.h"
#include "render/files/scene_file/toml/toml_reader.h"

namespace boule::toml_clips {
namespace {

Result<LoadedScene> read(const std::string& tables) {
  return read_toml("schema = 1\n[[sphere]]\ncenter = [1000000, 0, 0]\n" + tables, "cut.toml", {});
}

TEST(TomlClips, AreCountedFromTheOrigin) {
  const auto loaded = read(
      "[[clip]]\npoint = [1000000.25, 1, 2]\nnormal = [3, 0, 4]\n[[clip]]\nnormal = [0, 0, 1]\n");
  ASSERT_TRUE(loaded);
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.clips.size(), 2U);
  EXPECT_EQ(loaded.value().origin, (Vec3d{1000000, 0, 0}));
  EXPECT_EQ(scene.clips[0].point, (Vec3f{0.25F, 1, 2}));
  EXPECT_EQ(scene.clips[0].normal, (Vec3f{3, 0, 4}));
  EXPECT_EQ(scene.clips[1].point, (Vec3f{-1000000, 0, 0}));
}

TEST(TomlClips, WrongOnesNameTheirPlace) {
  struct Wrong {
    const char *table, *error;
  };
  for (const auto& [table, error] :
       {Wrong{"normal = [0, 0, 0]", "must not be the zero vector (key 'clip[1].normal')"},
        Wrong{"normal = [nan, 0, 1]", "must be finite (key 'clip[1].normal')"},
        Wrong{"point = [0, inf, 0]", "must be finite (key 'clip[1].point')"},
        Wrong{"point = [0, 1]", "(key 'clip[1].point')"},
        Wrong{"material = \"m\"", "unknown key 'material'"},
        Wrong{"norml = [0, 0, 1]", "did you mean 'normal'? (key 'clip[1].norml')"}}) {
    const auto loaded = read("[[clip]]\n[[clip]]\n" + std::string(table) + "\n");
    ASSERT_FALSE(loaded);
    const std::string text = format_diagnostic(loaded.error());
    EXPECT_TRUE(text.starts_with("cut.toml:6:")) << text;
    EXPECT_NE(text.find(error), std::string::npos) << text;
  }
  EXPECT_FALSE(read_toml("schema = 1\n[[group.g.clip]]\n", "cut.toml", {}));
}

TEST(TomlClips, ScenesInMemoryAreChecked) {
  Scene scene;
  scene.clips = {{}, {{}, {0, 0, 0}}};
  const Status done = validate(scene);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "clip[1].normal");
}

TEST(TomlClips, PackedScenesKeepThem) {
  PackedContents contents;
  const std::string without = encode(contents);
  contents.scene.clips = {{{1, 2, 3}, {0, 0, 2}}};
  const auto back = decode(encode(contents));
  ASSERT_TRUE(back);
  ASSERT_EQ(back.value().scene.clips.size(), 1U);
  EXPECT_EQ(back.value().scene.clips[0].point, (Vec3f{1, 2, 3}));
  EXPECT_EQ(back.value().scene.clips[0].normal, (Vec3f{0, 0, 2}));
  EXPECT_EQ(without.find("clip"), std::string::npos);
}

}  // namespace
}  // namespace boule::toml_clips
