// What the headers of render promise for bad input, one after the other. renderer_test.cpp and
// tracer_test.cpp test the numbers in options and results; scene_file, image and cli test files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <climits>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "render/frame/live_passes.h"
#include "render/frame/partial_picture.h"
#include "render/integrators/whitted.h"
#include "render/memory/scene_memory.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/renderer.h"
#include "render/renderer/tracer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/support/test_scenes.h"

namespace boule::test::bad_input {
namespace {

using testing::HasSubstr;

constexpr auto nan = std::numeric_limits<float>::quiet_NaN();
constexpr auto inf = std::numeric_limits<float>::infinity();

/// Something that makes a scene invalid, and the key that the Diagnostic names.
struct Fault {
  const char* key;
  std::function<void(Scene&)> spoil;
};

constexpr std::uint32_t nowhere = 0xffffffff;

const Fault faults[] = {
    {"sphere[0].material", [](Scene& s) { s.spheres[0].material = nowhere; }},
    {"plane[0].material", [](Scene& s) { s.planes[0].material = 1000; }},
    {"sphere[0].material", [](Scene& s) { s.materials.clear(); }},
    {"sphere[1].center", [](Scene& s) { s.spheres[1].center.y = nan; }},
    {"sphere[1].radius", [](Scene& s) { s.spheres[1].radius = inf; }},
    {"plane[0].normal", [](Scene& s) { s.planes[0].normal = {}; }},
    {"group.a.sphere[0].material",
     [](Scene& s) {
       s.groups = {{"a", {{{}, 1, nowhere}}, {}, {}}};
     }},
    {"instance[0].group",
     [](Scene& s) {
       s.instances = {{nowhere, {}, {}, 1, {}}};
     }},
    {"instance[0].material",
     [](Scene& s) {
       s.groups = {{"a", {}, {}, {}}};
       s.instances = {{0, {}, {}, 1, nowhere}};
     }},
    {"instance[0].scale",
     [](Scene& s) {
       s.groups = {{"a", {{{}, 1, 0}}, {}, {}}};
       s.instances = {{0, {}, {}, nan, {}}};
     }},
    {"group.a.instance[0].group",
     [](Scene& s) {
       s.groups = {{"a", {{{}, 1, 0}}, {}, {{0, {}, {}, 1, {}}}}};
       s.instances = {{0, {}, {}, 1, {}}};
     }},
    {"background.file", [](Scene& s) { s.background = EnvironmentBackground{}; }},
    {"background.file",
     [](Scene& s) {
       s.background = EnvironmentBackground{INT_MAX, INT_MAX, {{1, 1, 1}}, 0};
     }},
    {"background.file",
     [](Scene& s) {
       s.background = EnvironmentBackground{-1, -1, {{1, 1, 1}}, 0};
     }},
    {"background.up",
     [](Scene& s) {
       s.background = GradientBackground{{}, {}, {}};
     }},
    {"camera.distortion.file", [](Scene& s) { s.distortion = DistortionMap{}; }},
    {"camera.distortion.file",
     [](Scene& s) {
       s.distortion = DistortionMap{1000, 1000, {0, 0}};
     }},
    {"camera.distortion.file",
     [](Scene& s) {
       s.distortion = DistortionMap{-2, -2, std::vector<float>(8)};
     }},
    {"camera.file", [](Scene& s) { s.camera = LensCamera{}; }},
    {"camera.look_at",
     [](Scene& s) {
       s.camera = FisheyeCamera{{{}, {}, {0, 1, 0}}};
     }},
    {"light[0].radius",
     [](Scene& s) {
       s.lights = {SphereLight{{}, -1}};
     }},
    {"material.0.ior",
     [](Scene& s) {
       s.materials[0].material = Glass{{1, 1, 1}, nan};
     }},
};

/// Every use of an invalid scene refuses it with the same words.
TEST(BadInput, EveryDoorRefusesAnInvalidScene) {
  for (const Fault& fault : faults) {
    Scene scene = mixed_scene(8, 8);
    const RenderOptions options = options_of(scene);
    ASSERT_TRUE(validate(scene));
    fault.spoil(scene);
    const Status expected = validate(scene);
    ASSERT_FALSE(expected) << fault.key;
    EXPECT_EQ(expected.error().key, fault.key);
    EXPECT_TRUE(check_scene_memory(scene)) << fault.key;
    const auto renderer = Renderer::create(scene, options);
    const auto tracer = Tracer::create(scene);
    const auto prepared = prepare(scene, 8, 8);
    ASSERT_FALSE(renderer || tracer || prepared) << fault.key;
    for (const Diagnostic& found : {renderer.error(), tracer.error(), prepared.error()}) {
      EXPECT_EQ(format_diagnostic(found), format_diagnostic(expected.error()));
    }
  }
}

TEST(BadInput, PreparingForAnEmptyPictureFails) {
  for (const auto& [width, height] :
       {std::pair{0, 8}, {8, 0}, {-1, 8}, {65536, 8}, {8, INT_MIN}, {INT_MAX, INT_MAX}}) {
    const auto prepared = prepare(mixed_scene(8, 8), width, height);
    ASSERT_FALSE(prepared);
    EXPECT_EQ(prepared.error().key, "image.size");
  }
}

TEST(BadInput, OptionsOfAnySizeAreJudged) {
  constexpr int odd[] = {INT_MIN, INT_MIN + 1, -1, 0, 65536, INT_MAX};
  constexpr int RenderOptions::*sides[] = {&RenderOptions::width, &RenderOptions::height};
  for (const int value : odd) {
    for (const auto side : sides) {
      RenderOptions options;
      options.*side = value;
      EXPECT_FALSE(validate(options)) << value;
    }
    RenderOptions options;
    options.spp = options.max_depth = value;
    EXPECT_EQ(validate(options).ok(), value >= 1) << value;
    for (const PixelRect& crop :
         {PixelRect{value, 0, 9, 9}, PixelRect{0, value, 9, 9}, PixelRect{0, 0, value, 9},
          PixelRect{0, 0, 9, value}, PixelRect{INT_MIN, value, INT_MAX, INT_MAX}}) {
      RenderOptions cropped;
      cropped.crop = crop;
      EXPECT_EQ(validate(cropped).ok(), (crop == PixelRect{0, 0, 9, 9} && value == 0));
    }
  }
  RenderOptions options;
  options.order = static_cast<PixelOrder>(9);
  options.solver = static_cast<Solver>(9);
  options.method = static_cast<Method>(9);
  options.filter = static_cast<PixelFilter>(9);
  options.width = options.height = 8;
  auto renderer = Renderer::create(mixed_scene(8, 8), options);
  ASSERT_TRUE(renderer);
  EXPECT_TRUE(renderer.value().render());
  Film film(renderer.value().rect());
  EXPECT_TRUE(renderer.value().render_live(film));
}

TEST(BadInput, ARendererThatWasMovedAwayRefuses) {
  const Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  options.aovs.id = true;
  Renderer first = Renderer::create(scene, options).value();
  Renderer second = std::move(first);
  Film film(second.rect());
  EXPECT_EQ(first.render().error().message, "the renderer was moved away");
  EXPECT_EQ(first.render_aovs().error().message, "the renderer was moved away");
  EXPECT_EQ(first.render_pass(film, 1).error().message, "the renderer was moved away");
  EXPECT_EQ(first.render_live(film).error().message, "the renderer was moved away");
  first = std::move(second);
  EXPECT_TRUE(first.render());
  Renderer third = Renderer::create(scene, options).value();
  third = std::move(first);
  EXPECT_EQ(first.render().error().message, "the renderer was moved away");  // NOLINT
  EXPECT_TRUE(third.render());
}

TEST(BadInput, ATracerThatWasMovedAwayRefuses) {
  Tracer first = Tracer::create(mixed_scene(8, 8)).value();
  Tracer second = std::move(first);
  const std::array<Ray, 3> rays{};
  std::array<TracedHit, 3> hits;
  std::array<std::uint8_t, 3> met{};
  EXPECT_EQ(first.closest(rays, hits).error().message, "the tracer was moved away");
  EXPECT_EQ(first.any(rays, met).error().message, "the tracer was moved away");
  EXPECT_EQ(first.statistics().rays, 0U);
  first = std::move(second);
  EXPECT_TRUE(first.closest(rays, hits));
  Tracer third = Tracer::create(mixed_scene(8, 8)).value();
  third = std::move(first);
  EXPECT_EQ(first.closest(rays, hits).error().message, "the tracer was moved away");  // NOLINT
  EXPECT_TRUE(third.any(rays, met));
}

TEST(BadInput, MovedFromFilmIsEmpty) {
  const Scene scene = mixed_scene(8, 8);
  Renderer renderer = Renderer::create(scene, options_of(scene)).value();
  Film film(renderer.rect());
  film.add(3, 3, {1, 1, 1});
  const Film kept = std::move(film);
  EXPECT_EQ(kept.samples(3, 3), 1);
  EXPECT_TRUE(film.rect().empty());  // NOLINT: that is the test
  EXPECT_EQ(film.total_samples(), 0U);
  EXPECT_EQ(film.to_image().pixels.size(), 0U);
  EXPECT_FALSE(renderer.render_pass(film, 1));
  EXPECT_FALSE(renderer.render_live(film));
  film.restart(renderer.rect());
  EXPECT_TRUE(renderer.render_pass(film, 1));
  Film another({0, 0, 2, 2});
  another = std::move(film);
  EXPECT_TRUE(film.rect().empty());  // NOLINT: moved away again, that is the test
  EXPECT_EQ(another.total_samples(), 64U);
}

TEST(BadInput, FilmsAndPicturesWithoutPixelsHaveNone) {
  for (const PixelRect& rect : {PixelRect{}, PixelRect{5, 5, 5, 9}, PixelRect{9, 0, 2, 3},
                                PixelRect{INT_MAX, 0, INT_MIN, 1}}) {
    const Film film(rect);
    for (const PixelOrder order : {PixelOrder::rows, PixelOrder::progressive, PixelOrder::frameless,
                                   static_cast<PixelOrder>(9)}) {
      EXPECT_EQ(partial_picture(film, order).pixels.size(), 0U);
      EXPECT_EQ(BlockOrder(rect, 8, order).size(), 0U);
    }
    EXPECT_EQ(BlockOrder::bytes(rect, 8), 0U);
    EXPECT_EQ(Film::bytes(rect), 0U);
  }
  for (const auto& [width, height] : {std::pair{-1, -1}, {-5, 3}, {3, INT_MIN}, {0, 7}}) {
    const Image image(width, height);
    EXPECT_EQ(image.pixels.size(), 0U);
    EXPECT_GE(image.width, 0);
    EXPECT_GE(image.height, 0);
  }
}

TEST(BadInput, TooLargeRequestsFailAndLoseNothing) {
  const PixelRect all{INT_MIN, INT_MIN, INT_MAX, INT_MAX};
  EXPECT_EQ(all.area(), std::uint64_t{UINT_MAX} * UINT_MAX);
  EXPECT_THROW(Film{all}, std::length_error);
  EXPECT_THROW(Image(INT_MAX, INT_MAX), std::length_error);
  Film film({0, 0, 2, 2});
  film.add(1, 1, {1, 1, 1});
  EXPECT_THROW(film.restart(all), std::length_error);
  EXPECT_EQ(film.rect(), (PixelRect{0, 0, 2, 2}));
  EXPECT_EQ(film.samples(1, 1), 1);
}

TEST(BadInput, TilesAndSamplesAreClamped) {
  const PixelRect rect{0, 0, 3, 2};
  for (const int tile : {INT_MIN, -1, 0}) {
    EXPECT_EQ(BlockOrder(rect, tile, PixelOrder::tiles).size(), 6U);
    EXPECT_EQ(BlockOrder::bytes(rect, tile), BlockOrder::bytes(rect, 1));
    EXPECT_EQ(block_pixels(tile).size(), 1U);
  }
  EXPECT_EQ(BlockOrder(rect, INT_MAX, PixelOrder::tiles).size(), 1U);
  EXPECT_EQ(BlockOrder(rect, INT_MAX, PixelOrder::tiles)[0], rect);
  EXPECT_EQ(block_pixels(INT_MAX).size(), std::size_t{max_tile} * max_tile);
  for (const int spp : {INT_MIN, -1, 0, 1}) {
    EXPECT_EQ(LivePasses(PixelOrder::rows, rect, spp).size(), 1U);
    const LivePasses passes(PixelOrder::progressive, rect, spp);
    EXPECT_EQ(passes.size(), 5U);
    EXPECT_EQ(passes[4].share, 1);
  }
}

TEST(BadInput, DirectionsThatAreNoneSeeSomePixel) {
  const EnvironmentBackground image{3, 2, std::vector<Color>(6, {1, 2, 3}), 30};
  constexpr auto bad = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3d& odd :
       {Vec3d{bad, 1, 0}, Vec3d{0, bad, 1}, Vec3d{bad, bad, bad}, Vec3d{bad, 0, -1},
        Vec3d{1, 0, bad}, Vec3d{}, Vec3d{double{inf}, double{inf}, 0}}) {
    const Color seen = environment_radiance(image, odd);
    EXPECT_FLOAT_EQ(seen.r, 1);
    EXPECT_FLOAT_EQ(seen.g, 2);
    EXPECT_FLOAT_EQ(seen.b, 3);
  }
}

/// A caller's own rays, before an image and before a gradient.
TEST(BadInput, RaysThatAreNoneSeeSomeBackground) {
  Scene scene = mixed_scene(8, 8);
  for (const Background& background : std::initializer_list<Background>{
           EnvironmentBackground{3, 2, std::vector<Color>(6, {1, 2, 3}), 30},
           GradientBackground{}}) {
    scene.background = background;
    const PreparedScene prepared = prepare(scene, 8, 8).value();
    Whitted whitted(prepared, *select_kernels("auto").value(), {});
    RayBuffer rays(6);
    const Vec3f odd[] = {{nan, 1, 0}, {0, nan, 1}, {1, 0, nan}, {}, {inf, 0, 0}, {0, -inf, 0}};
    for (std::size_t i = 0; i < 6; ++i) rays.set(i, {{0, 1, 9}, odd[i]});
    std::array<Color, 6> radiance;
    ASSERT_TRUE(whitted.trace({rays, Coherence::none, nullptr}, radiance.data()));
    for (const Color& c : radiance) {
      for (const float x : {c.r, c.g, c.b}) EXPECT_TRUE(std::isfinite(x) && x >= 0) << x;
    }
  }
}

/// A callback whose copying throws.
struct Uncopyable {
  Uncopyable() = default;
  Uncopyable(Uncopyable&&) = default;
  Uncopyable(const Uncopyable&) { throw std::runtime_error("not to be copied"); }
  void operator()(const Progress&) const {}
};

TEST(BadInput, WhatCallbacksThrowIsADiagnostic) {
  const Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  options.progress = [](const Progress&) { throw 7; };
  Renderer renderer = Renderer::create(scene, options).value();
  EXPECT_EQ(renderer.render().error().message, "unknown failure");
  TraceOptions tracing;
  tracing.progress = options.progress;
  Tracer tracer = Tracer::create(scene, tracing).value();
  const std::array<Ray, 3> rays{};
  std::array<TracedHit, 3> hits;
  EXPECT_EQ(tracer.closest(rays, hits).error().message, "unknown failure");

  options.progress = Uncopyable();
  tracing.progress = Uncopyable();
  EXPECT_EQ(Renderer::create(scene, options).error().message, "not to be copied");
  EXPECT_EQ(Tracer::create(scene, tracing).error().message, "not to be copied");
}

TEST(BadInput, ExceptionsOfUpdateReachTheCaller) {
  const Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  int calls = 0;
  options.update = [&calls](const Film&) {
    if (++calls == 1) throw std::runtime_error("seen enough");
  };
  Renderer renderer = Renderer::create(scene, options).value();
  Film film(renderer.rect());
  EXPECT_THROW((void)renderer.render_live(film), std::runtime_error);
  EXPECT_TRUE(renderer.render_live(film));
  EXPECT_TRUE(renderer.render());
}

TEST(BadInput, AnEmptyLoopBodyIsADiagnostic) {
  Scheduler scheduler(3);
  EXPECT_FALSE(scheduler.run(5, {}));
  EXPECT_TRUE(scheduler.run(0, {}));
  EXPECT_THROW(scheduler.parallel_for()(5, {}), std::bad_function_call);
  EXPECT_THAT(diagnose({}).error().message, HasSubstr("bad_function_call"));
  EXPECT_EQ(diagnose([] { throw 7; }).error().message, "unknown failure");
}

}  // namespace
}  // namespace boule::test::bad_input
