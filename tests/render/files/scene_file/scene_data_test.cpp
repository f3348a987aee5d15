// Scenes as trees, and what they have in memory in place of files.
#include "render/files/scene_file/loaded/scene_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "render/files/scene_file/scene_tree.h"
#include "render/renderer/scene_hash.h"

namespace boule {
namespace {

using testing::HasSubstr;

/// A member of a tree; places count up, so that order is that of the calls.
TomlMember member(const std::string& key, decltype(TomlValue::data) data) {
  static int line = 0;
  const TextPlace place{++line, 1};
  return {key, place, {place, std::move(data)}};
}

TomlArray one_table(TomlMembers members) {
  TomlArray array;
  array.push_back(member("", std::move(members)).value);
  return array;
}

/// A scene of the spheres that have this name.
TomlMembers scene_of(const std::string& file) {
  TomlMembers root;
  root.push_back(member("schema", std::int64_t{1}));
  TomlMembers spheres;
  spheres.push_back(member("file", file));
  root.push_back(member("spheres", one_table(std::move(spheres))));
  return root;
}

SceneData with(SphereArrays arrays) {
  SceneData data;
  data.spheres.emplace("mine", std::make_shared<const SphereArrays>(std::move(arrays)));
  return data;
}

Result<LoadedScene> load(const SceneData& data) {
  SceneFileOptions options;
  options.data = &data;
  return load_scene_tree(scene_of("mine"), "", options);
}

SphereArrays exact(double moved) {
  SphereArrays arrays;
  arrays.spheres = {{{}, 0.5F, MaterialRef()}, {{}, 0.25F, MaterialRef()}};
  arrays.centers = {{moved + 0.125, 0, 0}, {moved + 1, 2, 0}};
  return arrays;
}

TEST(SceneData, TreeSpheresMatchTheText) {
  const auto made = load(with(exact(0)));
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto told = load_scene_text(
      "schema = 1\nsphere = [{center = [0.125, 0, 0], radius = 0.5}, "
      "{center = [1, 2, 0], radius = 0.25}]\n",
      "text.toml");
  EXPECT_EQ(scene_hash(made.value().scene), scene_hash(told.value().scene));
}

TEST(SceneData, FarSpheresAreRoundedAfterSubtractingOrigins) {
  const auto near = load(with(exact(0))), far = load(with(exact(1e6)));
  ASSERT_TRUE(far.ok());
  EXPECT_EQ(far.value().origin, (Vec3d{1e6, 0, 0}));
  EXPECT_EQ(scene_hash(near.value().scene), scene_hash(far.value().scene));
  SphereArrays too_far = exact(0);
  too_far.centers[1].y = 1e300;
  std::vector<Sphere> spheres(3);
  const Status done = too_far.append_to(spheres, {});
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("row 1"));
  EXPECT_EQ(spheres.size(), 3u);
}

TEST(SceneData, SpheresAreMovedFromTheirBase) {
  SphereArrays arrays;
  arrays.spheres = {{{1, 2, 3}, 1, MaterialRef()}};
  arrays.base = {10, 0, 0};
  std::vector<Sphere> spheres;
  ASSERT_TRUE(arrays.append_to(spheres, {10, 0, 0}));
  ASSERT_TRUE(arrays.append_to(spheres, {4, 0, 0}));
  EXPECT_EQ(spheres[0].center, (Vec3f{1, 2, 3}));
  EXPECT_EQ(spheres[1].center, (Vec3f{7, 2, 3}));
}

TEST(SceneData, MaterialsAreFoundByTheirNames) {
  SphereArrays arrays = exact(0);
  arrays.materials = {"blue", "red"};
  arrays.spheres[1].material = MaterialRef::colored(1, {1, 2, 3});
  arrays.has_colors = true;
  const SceneData data = with(arrays);
  SceneFileOptions options;
  options.data = &data;
  TomlMembers root = scene_of("mine");
  TomlMembers materials;
  for (const char* name : {"red", "blue"}) materials.push_back(member(name, TomlMembers{}));
  root.push_back(member("material", materials));
  const auto made = load_scene_tree(root, "", options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto& spheres = made.value().scene.spheres;
  EXPECT_EQ(spheres[0].material, MaterialRef(1U));
  EXPECT_EQ(spheres[1].material, MaterialRef::colored(0, {1, 2, 3}));
  const auto unknown = load(data);
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().message, HasSubstr("unknown material 'blue'"));
}

TEST(SceneData, InMemoryParticlesReadLikeAFile) {
  ParticleFrame frame;
  frame.positions = {{0, 0, 0}, {1, 0, 0}};
  frame.numbers.push_back({"radius", {0.5, 0.25}});
  SceneData data;
  data.particles.emplace("mine",
                         std::make_shared<ParticleFile>(ParticleFile::of(std::move(frame))));
  SceneFileOptions options;
  options.data = &data;
  const auto made =
      load_scene_text("schema = 1\n[[particles]]\nfile = \"mine\"\n", "text.toml", options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_EQ(made.value().scene.spheres.size(), 2u);
  EXPECT_EQ(made.value().scene.spheres[1].radius, 0.25F);
  EXPECT_TRUE(made.value().data_files.size() <= 1);
}

TEST(SceneData, PicturesInMemoryAreBackgrounds) {
  auto image = std::make_shared<Image>(2, 1);
  image->pixels = {{1, 2, 3}, {4, 5, 6}};
  SceneData data;
  data.pictures.emplace("sky", image);
  SceneFileOptions options;
  options.data = &data;
  const std::string text = "schema = 1\n[background]\ntype = \"environment\"\nfile = \"sky\"\n";
  const auto made = load_scene_text(text, "text.toml", options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto& sky = std::get<EnvironmentBackground>(made.value().scene.background);
  EXPECT_EQ(sky.width, 2);
  EXPECT_EQ(sky.pixels[1], (Color{4, 5, 6}));
  EXPECT_FALSE(load_scene_text(text, "text.toml").ok());
}

}  // namespace
}  // namespace boule
