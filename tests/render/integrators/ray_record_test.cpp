// The recorded recursion of a pixel against the picture, and against itself.
#include "render/integrators/ray_record.h"

#include <gtest/gtest.h>

#include "render/integrators/sample_faults.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// Expects that every pixel's rays add up to the picture with one sample, in every bit.
void expect_sums(const Scene& scene, const RenderOptions& options) {
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  const Image picture = renderer.value().render().value();
  int wrong = 0;
  std::size_t rays = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      RayRecord record;
      const auto weight = renderer.value().record_pixel(x, y, record);
      ASSERT_TRUE(weight);
      SampleFaults faults;
      const Color sum = settled(record.total(), faults);
      const Color pixel = weight.value() == 1 ? sum : settled(sum * weight.value(), faults);
      wrong += same_bits(weight.value() == 0 ? Color{} : pixel, picture.at(x, y)) ? 0 : 1;
      rays += record.rays().size();
    }
  }
  EXPECT_EQ(wrong, 0) << name_of(options.solver) << options.shadow_epsilon.has_value();
  EXPECT_GT(rays, picture.pixels.size());
}

TEST(RayRecord, AddsUpToThePicture) {
  for (const Scene& scene : {mixed_scene(48, 36), glass_cloud(40, 30)}) {
    for (const Solver solver : {Solver::fast, Solver::robust, Solver::reference}) {
      RenderOptions options = options_of(scene);
      options.solver = solver;
      expect_sums(scene, options);
    }
    RenderOptions options = options_of(scene);
    options.shadow_epsilon = 1e-4F;
    options.max_depth = 3;
    expect_sums(scene, options);
  }
}

TEST(RayRecord, AddsUpUnderALens) {
  Scene scene = mixed_scene(24, 18);
  scene.camera = ThinLensCamera{{{0, 1, 6}, {0, 1, 0}, {0, 1, 0}}, 40, FovAxis::x, 0.3f, {}};
  expect_sums(scene, options_of(scene));
}

TEST(RayRecord, IsATree) {
  const Scene scene = mixed_scene(48, 36);
  auto renderer = Renderer::create(scene, options_of(scene));
  int shadows = 0, blocked = 0, refracted = 0;
  for (int i = 0; i < 36; ++i) {
    RayRecord record;
    ASSERT_TRUE(renderer.value().record_pixel(i + 4, i, record));
    const auto& rays = record.rays();
    ASSERT_FALSE(rays.empty());
    EXPECT_EQ(rays[0].parent, -1);
    for (std::size_t k = 1; k < rays.size(); ++k) {
      ASSERT_GE(rays[k].parent, 0);
      ASSERT_LT(static_cast<std::size_t>(rays[k].parent), k);
      const RecordedRay& parent = rays[static_cast<std::size_t>(rays[k].parent)];
      const bool is_shadow = rays[k].kind == RayKind::shadow;
      EXPECT_EQ(rays[k].depth, parent.depth + (is_shadow ? 0 : 1));
      EXPECT_NE(parent.kind, RayKind::shadow);
      shadows += is_shadow ? 1 : 0;
      blocked += is_shadow && rays[k].hit.id != no_primitive ? 1 : 0;
      refracted += rays[k].kind == RayKind::refraction ? 1 : 0;
      // What blocks a shadow ray lets nothing through, and lies before the light.
      if (is_shadow && rays[k].hit.id != no_primitive) {
        EXPECT_EQ(rays[k].own, Color{});
        EXPECT_LE(rays[k].hit.t, static_cast<double>(rays[k].ray.tmax));
      }
    }
  }
  EXPECT_GT(shadows, 0);
  EXPECT_GT(blocked, 0);
  EXPECT_GT(refracted, 0);
}

TEST(RayRecord, RaysReturnTheirOwnAndChildrensLight) {
  const Scene scene = mixed_scene(48, 36);
  auto renderer = Renderer::create(scene, options_of(scene));
  RayRecord record;
  ASSERT_TRUE(renderer.value().record_pixel(24, 20, record));
  const auto returned = record.returned();
  const auto& rays = record.rays();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Color sum = rays[i].own;
    for (std::size_t k = i + 1; k < rays.size(); ++k) {
      if (rays[k].parent == static_cast<int>(i) && rays[k].kind != RayKind::shadow)
        sum = sum + light_product(rays[k].weight, returned[k]);
    }
    EXPECT_TRUE(same_bits(returned[i], sum));
  }
  // In another order than the picture's: equal but for rounding.
  EXPECT_NEAR(static_cast<double>(returned[0].r), static_cast<double>(record.total().r), 1e-5);
}

TEST(RayRecord, DirectLightSumsTheShadowRays) {
  Scene scene = empty_scene(8, 8);
  scene.spheres = {{{0, 0, 0}, 1, add_material(scene, Matte{{1, 1, 1}})}};
  scene.lights = {PointLight{{3, 3, 5}, {1, 1, 1}}, PointLight{{-3, 1, 5}, {0.5f, 0.5f, 0.5f}}};
  auto renderer = Renderer::create(scene, options_of(scene));
  RayRecord record;
  ASSERT_TRUE(renderer.value().record_pixel(4, 4, record));
  ASSERT_EQ(record.rays().size(), 3u);
  EXPECT_EQ(record.rays()[1].light, 0u);
  EXPECT_EQ(record.rays()[2].light, 1u);
  const Color sum = record.rays()[1].own + record.rays()[2].own;
  EXPECT_TRUE(same_bits(sum, record.rays()[0].own));
}

}  // namespace
}  // namespace boule::test
