#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/files/scene_file/scene_file.h"
#include "render/renderer/renderer.h"
#include "tests/scenes/shipped.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// The scenes by name, without their extension.
std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path file_of(const std::string& scene, const char* extension) {
  return scenes_folder() / (scene + extension);
}

/// Options for a picture 32 pixels wide with one sample per pixel, of the scene's aspect.
RenderOptions thumbnail_options(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.height = std::max(1, 32 * options.height / options.width);
  options.width = 32;
  options.spp = 1;
  return options;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, LoadsAndRendersCompletely) {
  const auto loaded = load_scene(file_of(GetParam(), ".toml").string());
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  EXPECT_THAT(loaded.value().warnings, IsEmpty());

  const Scene& scene = loaded.value().scene;
  // In its own size: in that of a thumbnail spheres may be smaller than a pixel.
  const auto full = Renderer::create(scene, options_of(scene));
  ASSERT_TRUE(full.ok()) << format_diagnostic(full.error());
  EXPECT_THAT(full.value().notes(), IsEmpty());
  auto renderer = Renderer::create(scene, thumbnail_options(scene));
  ASSERT_TRUE(renderer.ok()) << format_diagnostic(renderer.error());

  const auto image = renderer.value().render();
  ASSERT_TRUE(image.ok()) << format_diagnostic(image.error());
  const std::vector<Color>& pixels = image.value().pixels;
  for (const Color& c : pixels) {
    ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
  }
  const bool is_flat = std::all_of(pixels.begin(), pixels.end(),
                                   [&](const Color& c) { return c == pixels.front(); });
  EXPECT_FALSE(is_flat);
}

TEST_P(ShippedScene, HasASmallPictureInTheGallery) {
  const std::string picture = read_bytes(file_of(GetParam(), ".jpg"));
  EXPECT_THAT(picture, testing::StartsWith("\xff\xd8\xff"));
  EXPECT_LE(picture.size(), 200U * 1024U);

  const std::string readme = read_bytes(scenes_folder() / "README.md");
  EXPECT_THAT(readme, HasSubstr("[![](" + GetParam() + ".jpg)](" + GetParam() + ".toml)"));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace boule::test
