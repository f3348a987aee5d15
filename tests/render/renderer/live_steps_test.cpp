// Rendering in steps, with scenes that renderers share and cameras that move.
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "render/frame/live_passes.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr PixelOrder all_orders[] = {PixelOrder::rows, PixelOrder::tiles, PixelOrder::progressive,
                                     PixelOrder::frameless};

Scene small_scene() {
  Scene scene = mixed_scene(61, 47);
  scene.image.spp = 3;
  return scene;
}

/// Steps until all is done; the number of steps.
int finish(Renderer& renderer, Film& film, LivePosition& position, const StepLimit& limit) {
  int steps = 0;
  while (!renderer.done(position)) {
    if (const auto done = renderer.render_step(film, position, limit); !done) {
      ADD_FAILURE() << format_diagnostic(done.error());
      return -1;
    }
    ++steps;
  }
  return steps;
}

TEST(LiveSteps, EndAsThePictureFromAnyStart) {
  const Scene scene = small_scene();
  const Image expected = render(scene);
  for (const PixelOrder order : all_orders) {
    for (const double rotated_by : {0.0, 0.3, 0.99}) {
      RenderOptions options = options_of(scene);
      options.order = order;
      options.tile = 8;
      options.threads = 3;
      auto renderer = Renderer::create(scene, options);
      ASSERT_TRUE(renderer);
      Film film(renderer.value().rect());
      LivePosition position{.rotated_by = rotated_by};
      EXPECT_EQ(renderer.value().share_done(position), 0);
      // No time at all: a block or so in each step.
      EXPECT_GT(finish(renderer.value(), film, position, {.seconds = 0}), 8);
      EXPECT_EQ(renderer.value().share_done(position), 1);
      EXPECT_EQ(differing_pixels(film.to_image(), expected), 0);
    }
  }
}

TEST(LiveSteps, StayNearTheirPixelBudget) {
  Scene scene = mixed_scene(128, 64);
  for (const PixelOrder order : all_orders) {
    RenderOptions options = options_of(scene);
    options.order = order;
    options.tile = 8;
    auto renderer = Renderer::create(scene, options);
    Film film(renderer.value().rect());
    LivePosition position;
    constexpr double pixels = 512;
    const int steps = finish(renderer.value(), film, position, {.seconds = 1e9, .pixels = pixels});
    // Order progressive also counts the pixels of a pass that it has already.
    EXPECT_GE(steps, 128 * 64 / pixels) << static_cast<int>(order);
    EXPECT_LE(steps, 2 * 128 * 64 / pixels + 20) << static_cast<int>(order);
  }
}

TEST(LiveSteps, RestartsTakeTheOldestPixelsFirst) {
  const Scene scene = mixed_scene(64, 64);
  for (const PixelOrder order : {PixelOrder::rows, PixelOrder::tiles, PixelOrder::frameless}) {
    RenderOptions options = options_of(scene);
    options.order = order;
    options.tile = 8;
    auto renderer = Renderer::create(scene, options);
    Film first(renderer.value().rect());
    LivePosition position;
    while (renderer.value().share_done(position) < 0.5)
      ASSERT_TRUE(renderer.value().render_step(first, position, {.seconds = 0}));
    position = renderer.value().restarted(position);
    Film second(renderer.value().rect());
    while (renderer.value().share_done(position) < 0.4)
      ASSERT_TRUE(renderer.value().render_step(second, position, {.seconds = 0}));
    int both = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x)
        both += first.samples(x, y) > 0 && second.samples(x, y) > 0 ? 1 : 0;
    }
    EXPECT_EQ(both, 0) << static_cast<int>(order);
  }
}

TEST(LiveSteps, CanBeCancelled) {
  const Scene scene = small_scene();
  std::atomic<bool> cancel{true};
  RenderOptions options = options_of(scene);
  options.cancel = &cancel;
  auto renderer = Renderer::create(scene, options);
  Film film(renderer.value().rect());
  LivePosition position;
  EXPECT_FALSE(renderer.value().render_step(film, position, {}));
}

std::shared_ptr<PreparedScene> prepared_for(const Scene& scene, int width, int height,
                                            Method method) {
  return std::make_shared<PreparedScene>(prepare(scene, width, height, serial_for, method).value());
}

Image picture_of(std::shared_ptr<const PreparedScene> scene, const RenderOptions& options) {
  auto renderer = Renderer::create(std::move(scene), options);
  if (!renderer) {
    ADD_FAILURE() << format_diagnostic(renderer.error());
    return {};
  }
  return renderer.value().render().value();
}

/// Scenes in which something depends on the camera: lights that go with it, or that are chosen.
std::vector<Scene> scenes_that_follow() {
  Scene placed = mixed_scene(40, 30);
  placed.lights.push_back(SphereLight{{-0.5f, 0.6f, 0.1f}, 0.2f, {9, 8, 7}, LightFrame::camera});
  placed.lights.push_back(DirectionalLight{{0.2f, -1, -0.3f}, {1, 1, 1}, LightFrame::camera});
  Scene dark = empty_scene(40, 30);
  dark.spheres = {{{0, 0, 0}, 1, add_material(dark, Matte{})}};
  dark.background = ConstantBackground{};
  return {mixed_scene(40, 30), placed, dark};
}

TEST(Reframe, EqualsANewPreparation) {
  const std::vector<Camera> cameras = {
      pinhole({2, 1, 5}, {0, 0.5f, 0}, 35),
      OrthographicCamera{{{1, 2, 6}, {0, 1, 0}, {0, 1, 0}}, 4},
      FisheyeCamera{{{0, 1, 3}, {0, 1, 0}, {0, 1, 0}}, 170},
      ThinLensCamera{{{0, 1, 6}, {0, 1, 0}, {0.1f, 1, 0}}, 40, FovAxis::y, 0.2f, {}}};
  for (Scene scene : scenes_that_follow()) {
    for (const Method method : {Method::whitted, Method::path}) {
      scene.image.spp = 2;
      scene.render.method = method;
      const auto shared = prepared_for(scene, 40, 30, method);
      for (const Camera& camera : cameras) {
        Scene other = scene;
        other.camera = camera;
        other.image.width = 33;
        other.image.height = 21;
        ASSERT_TRUE(reframe(*shared, camera, 33, 21));
        EXPECT_EQ(differing_pixels(picture_of(shared, options_of(other)), render(other)), 0);
      }
    }
  }
}

TEST(Reframe, RefusesInvalidCameras) {
  const Scene scene = mixed_scene(20, 15);
  const auto shared = prepared_for(scene, 20, 15, Method::whitted);
  const Camera blind = pinhole({1, 1, 1}, {1, 1, 1}, 45);
  const auto done = reframe(*shared, blind, 20, 15);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "camera.look_at");
  EXPECT_FALSE(reframe(*shared, *scene.camera, 0, 15));
  EXPECT_EQ(differing_pixels(picture_of(shared, options_of(scene)), render(scene)), 0);
}

TEST(Reframe, RenderersShareAScene) {
  const Scene scene = mixed_scene(40, 30);
  const auto shared = prepared_for(scene, 40, 30, Method::whitted);
  RenderOptions one = options_of(scene), other = one;
  other.solver = Solver::reference;
  other.order = PixelOrder::frameless;
  EXPECT_EQ(differing_pixels(picture_of(shared, one), picture_of(shared, other)), 0);
}

}  // namespace
}  // namespace boule::test
