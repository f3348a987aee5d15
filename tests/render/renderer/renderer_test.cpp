#include "render/renderer/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <stdexcept>

#include "render/memory/available_memory.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

TEST(RenderOptions, TakesTheScenesSettings) {
  Scene scene;
  scene.image = {123, 45, 6};
  scene.render.max_depth = 7;
  const RenderOptions options = options_of(scene);
  EXPECT_EQ(options.width, 123);
  EXPECT_EQ(options.height, 45);
  EXPECT_EQ(options.spp, 6);
  EXPECT_EQ(options.max_depth, 7);
  EXPECT_EQ(rendered_rect(options), (PixelRect{0, 0, 123, 45}));
}

TEST(Renderer, RefusesWrongOptionsByName) {
  struct Case {
    const char* key;
    std::function<void(RenderOptions&)> spoil;
  };
  const Case cases[] = {{"image.size", [](RenderOptions& o) { o.width = 0; }},
                        {"image.size", [](RenderOptions& o) { o.height = 65536; }},
                        {"image.spp", [](RenderOptions& o) { o.spp = 0; }},
                        {"render.max_depth", [](RenderOptions& o) { o.max_depth = -1; }},
                        {"tile", [](RenderOptions& o) { o.tile = -1; }},
                        {"tile", [](RenderOptions& o) { o.tile = 1025; }},
                        {"crop",
                         [](RenderOptions& o) {
                           o.crop = PixelRect{0, 0, 9, 8};
                         }},
                        {"crop",
                         [](RenderOptions& o) {
                           o.crop = PixelRect{-1, 0, 8, 8};
                         }},
                        {"crop", [](RenderOptions& o) {
                           o.crop = PixelRect{3, 3, 3, 5};
                         }}};
  const Scene scene = mixed_scene(8, 8);
  for (const Case& c : cases) {
    RenderOptions options = options_of(scene);
    c.spoil(options);
    const auto renderer = Renderer::create(scene, options);
    ASSERT_FALSE(renderer) << c.key;
    EXPECT_EQ(renderer.error().key, c.key);
  }
}

/// The bands of a picture, put together again.
Result<Image> from_bands(Renderer& renderer) {
  Image whole(renderer.rect().width(), renderer.rect().height(), alpha_of(renderer.options()));
  std::size_t pixels = 0;
  const Status done = renderer.render_bands([&](const Image& band) -> Status {
    if (band.width != whole.width) return Diagnostic::of("a band of another width");
    std::copy(band.pixels.begin(), band.pixels.end(),
              whole.pixels.begin() + static_cast<std::ptrdiff_t>(pixels));
    std::copy(band.alpha.begin(), band.alpha.end(),
              whole.alpha.begin() + static_cast<std::ptrdiff_t>(band.alpha.empty() ? 0 : pixels));
    pixels += band.pixels.size();
    return {};
  });
  if (!done) return done.error();
  if (pixels != whole.pixels.size()) return Diagnostic::of("other rows than the picture has");
  return whole;
}

TEST(Renderer, BandsAreThePictureForAnyThreads) {
  const Scene scene = mixed_scene(150, 130);
  RenderOptions options = options_of(scene);
  options.transparent = true;
  options.outline = 2;
  options.crop = PixelRect{3, 5, 149, 128};
  for (const int tile : {16, 64}) {
    options.tile = tile;
    auto whole = Renderer::create(scene, options);
    ASSERT_TRUE(whole);
    const auto expected = whole.value().render();
    ASSERT_TRUE(expected);
    for (const unsigned threads : {1U, 2U, 5U}) {
      options.threads = threads;
      auto renderer = Renderer::create(scene, options);
      ASSERT_TRUE(renderer);
      const auto picture = from_bands(renderer.value());
      ASSERT_TRUE(picture);
      EXPECT_EQ(picture.value().pixels, expected.value().pixels);
      EXPECT_EQ(picture.value().alpha, expected.value().alpha);
    }
  }
}

TEST(Renderer, BandCallbacksCanEndTheRendering) {
  const Scene scene = mixed_scene(64, 640);
  RenderOptions options = options_of(scene);
  options.tile = 16;
  options.threads = 3;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  int taken = 0;
  const Status done = renderer.value().render_bands([&](const Image&) -> Status {
    return ++taken == 2 ? Status(Diagnostic::of("enough")) : Status();
  });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "enough");
  EXPECT_EQ(taken, 2);
  const Status thrown = renderer.value().render_bands(
      [](const Image&) -> Status { throw std::runtime_error("thrown"); });
  ASSERT_FALSE(thrown);
  EXPECT_EQ(thrown.error().message, "thrown");
}

TEST(Renderer, RefusesAPictureLargerThanTheMemory) {
  const PixelRect frame{0, 0, 65535, 65535};
  if (Film::bytes(frame) < available_memory()) GTEST_SKIP() << "it fits into this machine";
  const Scene scene = mixed_scene(65535, 65535);
  const auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().key, "image.size");
  RenderOptions part = options_of(scene);
  part.crop = PixelRect{65530, 65530, 65535, 65535};  // only rendered pixels take memory
  EXPECT_TRUE(Renderer::create(scene, part));
}

TEST(Renderer, RefusesInvalidScenesAndUnknownIsas) {
  Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  options.isa = "mmx";
  EXPECT_FALSE(Renderer::create(scene, options));
  scene.spheres[2].radius = -1;
  const auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().key, "sphere[2].radius");
}

TEST(Renderer, PassesAddUpToThePicture) {
  Scene scene = mixed_scene(20, 15);
  scene.image.spp = 7;
  auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_TRUE(renderer);
  Film film(renderer.value().rect());
  for (const int until : {1, 2, 2, 6, 7}) {
    EXPECT_TRUE(renderer.value().render_pass(film, until));
    EXPECT_EQ(film.samples(3, 4), until);
  }
  EXPECT_EQ(differing_pixels(film.to_image(), render(scene)), 0);
}

TEST(Renderer, RefusesForeignFilmsAndExcessPasses) {
  const Scene scene = mixed_scene(8, 8);
  auto renderer = Renderer::create(scene, options_of(scene));
  Film film({0, 0, 8, 8}), foreign({0, 0, 8, 7});
  EXPECT_FALSE(renderer.value().render_pass(foreign, 1));
  EXPECT_FALSE(renderer.value().render_pass(film, 2));
  EXPECT_FALSE(renderer.value().render_pass(film, 0));
  EXPECT_TRUE(renderer.value().render_pass(film, 1));
}

TEST(Renderer, CancelledPassesResumeWhereTheyStopped) {
  Scene scene = mixed_scene(64, 64);
  scene.image.spp = 2;
  std::atomic<bool> cancel{false};
  RenderOptions options = options_of(scene);
  options.threads = 1;
  options.cancel = &cancel;
  bool impatient = true;
  options.progress = [&](const Progress& progress) { cancel = impatient && progress.share > 0.3; };
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  Film film(renderer.value().rect());
  const Status stopped = renderer.value().render_pass(film, 2);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(film.samples(0, 0), 2);
  EXPECT_EQ(film.samples(63, 63), 0);
  impatient = false;
  cancel = false;
  EXPECT_TRUE(renderer.value().render_pass(film, 2));
  EXPECT_EQ(differing_pixels(film.to_image(), render(scene)), 0);
}

TEST(Renderer, CancellingIsAnError) {
  const Scene scene = mixed_scene(8, 8);
  const std::atomic<bool> cancel{true};
  RenderOptions options = options_of(scene);
  options.cancel = &cancel;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  EXPECT_FALSE(renderer.value().render());
}

TEST(Renderer, ExceptionsOfProgressCallbacksBecomeDiagnostics) {
  const Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  options.threads = 1;
  options.progress = [](const Progress&) { throw std::bad_alloc(); };
  auto renderer = Renderer::create(scene, options);
  const auto image = renderer.value().render();
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().message, "out of memory");
}

TEST(Renderer, ExceptionsAfterTheLastBlockBecomeDiagnostics) {
  const Scene scene = mixed_scene(8, 8);
  RenderOptions options = options_of(scene);
  options.threads = 1;
  bool done = false;
  options.progress = [&done](const Progress& progress) {
    if (done && progress.share == 1) throw std::runtime_error("enough");
    done = progress.share == 1;  // after the last block
  };
  auto renderer = Renderer::create(scene, options);
  const auto image = renderer.value().render();
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().message, "enough");
}

TEST(Renderer, ReportsProgressUpToTheEnd) {
  const Scene scene = mixed_scene(64, 48);
  RenderOptions options = options_of(scene);
  options.threads = 2;
  double last = 0;
  std::uint64_t rays = 0;
  bool falls = false;
  options.progress = [&](const Progress& progress) {
    falls = falls || progress.share < last || progress.rays < rays;
    last = progress.share;
    rays = progress.rays;
  };
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer.value().render());
  EXPECT_FALSE(falls);
  EXPECT_EQ(last, 1);
  EXPECT_EQ(rays, renderer.value().statistics().rays.total());
}

/// LiveProgress, which any thread may read. Here the rendering thread reads it, because no other
/// thread is certain to run at a certain time.
TEST(Renderer, KeepsLiveProgressUpToDate) {
  const Scene scene = mixed_scene(64, 48);
  for (const PixelOrder order : {PixelOrder::tiles, PixelOrder::progressive}) {
    RenderOptions options = options_of(scene);
    options.spp = 2;
    options.threads = 1;
    options.order = order;
    LiveProgress live;
    options.live = &live;
    double last = 0;
    bool differs = false;
    options.progress = [&](const Progress& progress) {
      const Progress seen = live.read();
      differs = differs || seen.share != progress.share || seen.rays != progress.rays ||
                seen.running != 0 || seen.share < last;
      last = seen.share;
    };
    auto renderer = Renderer::create(scene, options);
    Film film(renderer.value().rect());
    EXPECT_TRUE(renderer.value().render_live(film));
    EXPECT_FALSE(differs);
    EXPECT_EQ(live.read().share, 1);
    EXPECT_EQ(live.read().rays, renderer.value().statistics().rays.total());
  }
}

TEST(LiveProgress, NamesTheCurrentWork) {
  LiveProgress live;
  EXPECT_EQ(live.read().share, 0);
  live.begin_pass(4, {.begin = 0.5, .end = 1, .rays = 100});
  live.begin_block();
  live.begin_block();
  live.end_block(10);
  const Progress progress = live.read();
  EXPECT_EQ(progress.share, 0.625);
  EXPECT_EQ(progress.rays, 110u);
  EXPECT_EQ(progress.running, 1u);
  live.drop_block();
  EXPECT_EQ(live.read().running, 0u);
  EXPECT_EQ(live.ended(), 1u);
}

TEST(Renderer, ReportsIsaAndRayCounts) {
  const Scene scene = mixed_scene(20, 10);
  RenderOptions options = options_of(scene);
  options.isa = "scalar";
  options.threads = 2;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer.value().render());
  const RenderStatistics statistics = renderer.value().statistics();
  EXPECT_EQ(statistics.isa, "scalar");
  EXPECT_EQ(statistics.width, 1);
  EXPECT_EQ(statistics.rays.primary, 200u);
  EXPECT_GT(statistics.rays.shadow, 200u);
  EXPECT_GT(statistics.rays.continuation, 50u);
  EXPECT_GT(statistics.render_seconds, 0);
  EXPECT_GT(statistics.prepare_seconds, 0);
  EXPECT_TRUE(statistics.threads >= 1 && statistics.threads <= 2);
}

TEST(Renderer, PassesTheNotesOn) {
  Scene scene = mixed_scene(8, 8);
  EXPECT_TRUE(Renderer::create(scene, options_of(scene)).value().notes().empty());
  scene.camera.reset();
  EXPECT_EQ(Renderer::create(scene, options_of(scene)).value().notes().size(), 1u);
}

TEST(Renderer, TakesTheSpheresOfMovedScenes) {
  Scene scene = mixed_scene(8, 8);
  const std::vector<Sphere> spheres = scene.spheres;
  const Plane* const plane = scene.planes.data();
  const Image expected = render(scene);
  auto copying = Renderer::create(scene, options_of(scene));
  EXPECT_EQ(scene.spheres.size(), spheres.size());
  const RenderOptions options = options_of(scene);
  auto keeping = Renderer::create(std::move(scene), options);
  EXPECT_TRUE(scene.spheres.empty());
  EXPECT_EQ(keeping.value().scene().planes.data(), plane);
  for (auto* renderer : {&copying, &keeping}) {
    EXPECT_EQ(differing_pixels(renderer->value().render().value(), expected), 0);
  }
}

TEST(Renderer, CanBeMovedBetweenPasses) {
  Scene scene = mixed_scene(20, 15);
  scene.image.spp = 2;
  auto created = Renderer::create(scene, options_of(scene));
  Renderer first = std::move(created).value();
  Film film(first.rect());
  EXPECT_TRUE(first.render_pass(film, 1));
  Renderer second = std::move(first);
  EXPECT_TRUE(second.render_pass(film, 2));
  EXPECT_EQ(differing_pixels(film.to_image(), render(scene)), 0);
}

}  // namespace
}  // namespace boule::test
