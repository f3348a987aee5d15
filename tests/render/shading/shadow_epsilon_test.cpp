// The lecture's remedy against false shadows, which is there to be compared with Boule's way.
#include <gtest/gtest.h>

#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// A ball on a ball, lit from one side, far from the origin's neighbourhood of small numbers.
Scene ball_scene(float scale) {
  Scene scene = empty_scene(96, 72);
  scene.camera = pinhole({0, 2 * scale, 6 * scale}, {0, 0.6f * scale, 0}, 40);
  const auto white = add_material(scene, Matte{{0.8f, 0.8f, 0.8f}});
  scene.spheres = {{{0, scale, 0}, scale, white}, {{0, -100 * scale, 0}, 100 * scale, white}};
  scene.lights = {PointLight{{3 * scale, 5 * scale, 4 * scale}, {1, 1, 1}}};
  return scene;
}

Image with_epsilon(const Scene& scene, std::optional<float> epsilon) {
  RenderOptions options = options_of(scene);
  options.shadow_epsilon = epsilon;
  return render(scene, options);
}

/// Pixels that are darker than they should be, and brighter.
struct Wrong {
  int dark = 0, bright = 0;
};
Wrong wrong_pixels(const Image& image, const Image& right) {
  Wrong wrong;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    wrong.dark += image.pixels[i].r < right.pixels[i].r - 1e-3F ? 1 : 0;
    wrong.bright += image.pixels[i].r > right.pixels[i].r + 1e-3F ? 1 : 0;
  }
  return wrong;
}

TEST(ShadowEpsilon, WithoutARemedyManyPixelsShadowThemselves) {
  for (const float scale : {0.01F, 1.0F, 1000.0F}) {
    const Scene scene = ball_scene(scale);
    const Image right = with_epsilon(scene, {});
    const Wrong wrong = wrong_pixels(with_epsilon(scene, 0.0F), right);
    EXPECT_GT(wrong.dark, 96 * 72 / 20) << scale;
    EXPECT_EQ(wrong.bright, 0) << scale;
  }
}

TEST(ShadowEpsilon, WorksForOneScaleOnly) {
  const Scene scene = ball_scene(1), large = ball_scene(10'000);
  constexpr float epsilon = 1e-3F;
  EXPECT_LT(wrong_pixels(with_epsilon(scene, epsilon), with_epsilon(scene, {})).dark, 8);
  EXPECT_GT(wrong_pixels(with_epsilon(large, epsilon), with_epsilon(large, {})).dark, 96 * 72 / 20);
}

TEST(ShadowEpsilon, LargeValuesLetLightThrough) {
  const Scene scene = ball_scene(1);
  const Wrong wrong = wrong_pixels(with_epsilon(scene, 1.5F), with_epsilon(scene, {}));
  EXPECT_GT(wrong.bright, 50);
}

TEST(ShadowEpsilon, HasTheSameBitsEverywhere) {
  Scene scene = mixed_scene(48, 36);
  for (const Method method : {Method::whitted, Method::path}) {
    scene.render.method = method;
    scene.image.spp = 2;
    RenderOptions options = options_of(scene);
    options.shadow_epsilon = 1e-5F;
    options.solver = Solver::reference;
    options.threads = 1;
    const Image expected = render(scene, options);
    options.solver = Solver::robust;
    options.threads = 3;
    for (const IsaInfo& info : list_isas()) {
      if (!info.supported) continue;
      options.isa = std::string(info.name);
      EXPECT_EQ(differing_pixels(render(scene, options), expected), 0) << info.name;
    }
  }
}

TEST(ShadowEpsilon, MovesPathsToo) {
  Scene scene = ball_scene(1);
  scene.render.method = Method::path;
  scene.lights = {SphereLight{{3, 5, 4}, 0.5F, {20, 20, 20}}};
  const Image right = with_epsilon(scene, {});
  EXPECT_GT(wrong_pixels(with_epsilon(scene, 0.0F), right).dark, 96 * 72 / 40);
}

TEST(ShadowEpsilon, IsALength) {
  const Scene scene = ball_scene(1);
  RenderOptions options = options_of(scene);
  options.shadow_epsilon = -1.0F;
  EXPECT_FALSE(validate(options));
  options.shadow_epsilon = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(validate(options));
  options.shadow_epsilon = 0.0F;
  EXPECT_TRUE(validate(options));
}

}  // namespace
}  // namespace boule::test
