// What a packed scene holds beside the large arrays: the same after it was written and read.
#include "render/files/packed/packed_contents.h"

#include <gtest/gtest.h>

#include "render/renderer/scene_hash.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// A scene with something in every field.
PackedContents full_contents() {
  PackedContents contents;
  Scene& scene = contents.scene;
  scene = mixed_scene(40, 30);
  contents.spheres.count = scene.spheres.size();
  contents.spheres.emissive = {scene.spheres[6]};
  contents.spheres.first = scene.spheres;
  contents.spheres.extremes = {scene.spheres[1], scene.spheres[3]};
  contents.spheres.made_of.resize(scene.materials.size(), 3);
  contents.chunks = {{contents.spheres.count, 16, 2}};
  scene.spheres.clear();
  contents.spheres.digest = 0xfedcba9876543210;
  contents.origin = {1e9, -2, 0.1};
  scene.background = EnvironmentBackground{2, 1, {{1, 2, 3}, {4, 5, 6}}, 30};
  scene.backdrop = Color{1, 0.5F, 0};
  scene.distortion = DistortionMap{2, 2, {0, 0, 1, 0, 0, 1, 1, 1}};
  scene.lights.push_back(SphereLight{{1, 2, 3}, 0.5F});
  LensCamera lens;
  lens.surfaces = {{50, 5, 1.5F, 30}, {-50, 0, 1, 30}};
  lens.focus = 7;
  lens.pose.look_at = {0, 0, -5};
  scene.camera = lens;
  return contents;
}

TEST(PackedContents, AreTheSameAfterwards) {
  const PackedContents contents = full_contents();
  const std::string bytes = encode(contents);
  const auto again = decode(bytes);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(again.value()), bytes);
  EXPECT_EQ(scene_hash(again.value().scene), scene_hash(contents.scene));
  EXPECT_EQ(again.value().origin, contents.origin);
  EXPECT_EQ(again.value().chunks[0].scanned, 16U);
}

TEST(PackedContents, OfEveryCameraAndBackground) {
  const Camera cameras[] = {PinholeCamera{}, OrthographicCamera{}, FisheyeCamera{},
                            ThinLensCamera{}};
  const Background backgrounds[] = {ConstantBackground{}, GradientBackground{}};
  for (const Camera& camera : cameras) {
    for (const Background& background : backgrounds) {
      PackedContents contents = full_contents();
      contents.scene.camera = camera;
      contents.scene.background = background;
      const auto again = decode(encode(contents));
      ASSERT_TRUE(again);
      EXPECT_EQ(scene_hash(again.value().scene), scene_hash(contents.scene));
    }
  }
}

/// Cut anywhere they are refused; with any byte changed they are refused, or some other scene.
TEST(PackedContents, MayBeAnyBytes) {
  const std::string bytes = encode(full_contents());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto cut = decode(std::string_view(bytes).substr(0, size));
    EXPECT_FALSE(cut) << size;
  }
  EXPECT_FALSE(decode(bytes + "x"));
  int refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int change : {1 << i % 8}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ change);
      const auto other = decode(changed);
      if (other) {
        EXPECT_TRUE(validate_all_but_primitives(other.value().scene));
      } else {
        EXPECT_FALSE(other.error().message.empty());
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 300);
}

TEST(PackedContents, WithoutTheOutermostSpheresAreDamaged) {
  PackedContents contents = full_contents();
  contents.spheres.extremes.clear();
  const auto other = decode(encode(contents));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().message, "its contents are damaged");
}

/// A key of a newer version is named.
TEST(PackedContents, NewerVersionsAreRefusedByKey) {
  std::string bytes = encode(full_contents());
  const std::size_t at = bytes.find("outline");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 7, "outlinx");
  const auto other = decode(bytes);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().message, "it holds 'outlinx', which this version of Boule does not know");
}

}  // namespace
}  // namespace boule::test
