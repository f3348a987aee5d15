// Primitives in colours of their own look as if each had a material of that colour.
#include <gtest/gtest.h>

#include "core/math/srgb.h"
#include "render/renderer/scene_hash.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// A colour for each primitive, none of them twice.
SrgbColor color_of(std::size_t i) {
  return {static_cast<std::uint8_t>(37 * i + 11), static_cast<std::uint8_t>(101 * i + 5),
          static_cast<std::uint8_t>(193 * i + 77)};
}

/// The scene with every second sphere and every plane in a colour of its own.
Scene with_own_colors(Scene scene) {
  for (std::size_t i = 0; i < scene.spheres.size(); i += 2) {
    MaterialRef& material = scene.spheres[i].material;
    material = MaterialRef::colored(material.index(), color_of(i));
  }
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    MaterialRef& material = scene.planes[i].material;
    material = MaterialRef::colored(material.index(), color_of(i + 1));
  }
  return scene;
}

/// The same scene with a material for every primitive that has a colour.
Scene with_materials(Scene scene) {
  const auto replace = [&scene](MaterialRef& material) {
    if (!material.has_color()) return;
    const Material& plain = scene.materials[material.index()].material;
    material = add_material(scene, recolored(plain, linear_of(material.color())));
  };
  for (Sphere& sphere : scene.spheres) replace(sphere.material);
  for (Plane& plane : scene.planes) replace(plane.material);
  return scene;
}

class OwnColors : public testing::TestWithParam<Method> {};

TEST_P(OwnColors, AreThoseOfMaterialsBitForBit) {
  Scene plain = mixed_scene(61, 47);
  plain.image.spp = 4;
  plain.render.method = GetParam();
  const Scene colored = with_own_colors(plain);
  const Image picture = render(colored);
  EXPECT_EQ(differing_pixels(picture, render(with_materials(colored))), 0);
  EXPECT_GT(differing_pixels(picture, render(plain)), 1000);
}

TEST_P(OwnColors, DoNotDependOnThreadsOrTiles) {
  Scene colored = with_own_colors(glass_cloud(40, 40));
  colored.render.method = GetParam();
  RenderOptions options = options_of(colored);
  const Image picture = render(colored, options);
  options.threads = 3;
  options.tile = 5;
  EXPECT_EQ(differing_pixels(picture, render(colored, options)), 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, OwnColors, testing::Values(Method::whitted, Method::path),
                         [](const auto& one) { return std::string(name_of(one.param)); });

TEST(OwnColors, AreInTheHash) {
  Scene scene = mixed_scene(8, 8);
  const std::uint64_t plain = scene_hash(scene);
  MaterialRef& material = scene.spheres[0].material;
  material = MaterialRef::colored(material.index(), {1, 2, 3});
  const std::uint64_t colored = scene_hash(scene);
  EXPECT_NE(colored, plain);
  material = MaterialRef::colored(material.index(), {1, 2, 4});
  EXPECT_NE(scene_hash(scene), colored);
}

TEST(OwnColors, AreTheAlbedo) {
  Scene scene = empty_scene(9, 9);
  scene.spheres = {
      {{0, 0, 0}, 1, MaterialRef::colored(add_material(scene, Matte{}), {9, 80, 200})}};
  scene.camera = PinholeCamera{{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}}, 20, FovAxis::x};
  RenderOptions options = options_of(scene);
  options.aovs.albedo = true;
  const auto channels = Renderer::create(scene, options).value().render_aovs();
  ASSERT_TRUE(channels.ok());
  const Color expected = linear_of({9, 80, 200});
  const float components[] = {expected.r, expected.g, expected.b};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(std::get<std::vector<float>>(channels.value()[c].samples)[40], components[c]);
  }
}

TEST(OwnColors, WithUnknownMaterialsAreRefused) {
  Scene scene = mixed_scene(8, 8);
  scene.spheres[0].material = MaterialRef::colored(120, {1, 2, 3});
  const Status done = validate(scene);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "sphere[0].material");
}

}  // namespace
}  // namespace boule::test
