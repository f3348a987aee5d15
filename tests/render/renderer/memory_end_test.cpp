#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "render/files/scene_file/scene_file.h"
#include "render/image/write_image.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/block_tools.h"
#include "render/renderer/renderer.h"
#include "render/renderer/tracer.h"
#include "tests/render/path_scenes.h"
#include "tests/render/renderer/counted_allocations.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_scenes.h"

/// Where memory ends: every allocation of every public function fails once, and then the function
/// is called again.
namespace boule::test {
namespace {

constexpr int side = 8;

using Numbers = std::vector<float>;

void add(Numbers& all, const Image& image) {
  for (const Color& pixel : image.pixels) all.insert(all.end(), {pixel.r, pixel.g, pixel.b});
  all.insert(all.end(), image.alpha.begin(), image.alpha.end());
}

struct Columns {
  std::vector<double> t = std::vector<double>(3000);
  std::vector<std::int32_t> id = std::vector<std::int32_t>(3000);
};

/// What a function works with, and what it has made.
struct Work {
  std::optional<Renderer> renderer;
  std::optional<Tracer> tracer;
  Film film{PixelRect{0, 0, side, side}};
  MeasuredPicture measured{PixelRect{0, 0, side, side}};
  Image image;
  std::vector<ImageChannel> channels;
  std::optional<Outline> outline;
  RayRecord record;
  Scene scene;
  std::vector<Ray> rays = std::vector<Ray>(3000, Ray{{0, 1, 5}, {0, 0, -1}});
  std::vector<TracedHit> hits = std::vector<TracedHit>(3000);
  Columns columns;
  std::vector<std::uint8_t> met = std::vector<std::uint8_t>(3000);
  Numbers more;  ///< has room for all that a function puts there

  Work() { more.reserve(10000); }
  [[nodiscard]] Numbers numbers() const;
};

Numbers Work::numbers() const {
  Numbers all = more;
  add(all, image);
  add(all, film.to_image());
  add(all, measured.image(Alpha::none));
  for (const ImageChannel& channel : channels)
    std::visit([&](const auto& samples) { all.insert(all.end(), samples.begin(), samples.end()); },
               channel.samples);
  for (int i = 0; outline && i < side * side; ++i)
    all.push_back(static_cast<float>(outline->ink(i % side, i / side)));
  for (const RecordedRay& ray : record.rays()) all.push_back(ray.own.r);
  for (const TracedHit& hit : hits) all.push_back(static_cast<float>(hit.t));
  all.insert(all.end(), met.begin(), met.end());
  for (const double t : columns.t) all.push_back(static_cast<float>(t));
  for (const std::int32_t id : columns.id) all.push_back(static_cast<float>(id));
  for (const Sphere& sphere : scene.spheres) all.push_back(sphere.center.x);
  return all;
}

/// Rays as columns, in place.
RayColumns columns(const std::vector<Ray>& rays) {
  const auto column = [](const auto& number) {
    using Number = std::remove_cvref_t<decltype(number)>;
    return RayNumbers{reinterpret_cast<const unsigned char*>(&number), sizeof(Ray), sizeof(Number),
                      std::is_same_v<Number, double>};
  };
  const Ray& first = rays[0];
  return {.size = rays.size(),
          .org = column(first.org.x),
          .dir = column(first.dir.x),
          .tmin = column(first.tmin),
          .tmax = column(first.tmax)};
}

using Make = std::function<void(Work&)>;
using Call = std::function<Status(Work&)>;

/// How often `call` was without memory, each time with what `make` has made anew, until all its
/// allocations have failed once. It returns the error, or gets along; called again it gives what it
/// gives otherwise.
long failures_of(const Make& make, const Call& call) {
  const auto made = [&] {
    auto work = std::make_unique<Work>();
    make(*work);
    return work;
  };
  const auto first = made();
  EXPECT_TRUE(call(*first));
  const Numbers right = first->numbers();
  for (long number = 1; number < 100000; ++number) {
    const auto work = made();
    Status status;
    bool has_come = true;
    try {
      const OneFailure failure(number);
      status = call(*work);
      has_come = failure.has_come();
    } catch (const std::exception& thrown) {
      ADD_FAILURE() << "allocation " << number << ": throws " << thrown.what();
    }
    if (!has_come) return number - 1;
    if (!status) {
      EXPECT_NE(status.error().message, "") << number;
      status = call(*work);
    }
    EXPECT_TRUE(status) << number;
    EXPECT_EQ(work->numbers(), right) << number;
    if (testing::Test::HasFailure()) break;
  }
  return 0;
}

/// Moves a result's value to where it is kept.
template <class T, class Kept>
Status keep(Result<T> result, Kept& kept) {
  if (!result) return result.error();
  kept = std::move(result).value();
  return {};
}

struct Case {
  std::string name;
  Scene scene;
  RenderOptions options;
};

Case picture(const std::string& name, const Scene& scene, RenderOptions options = {}) {
  options.width = options.height = side;
  options.threads = 1;
  options.method = scene.render.method;
  options.max_depth = scene.render.max_depth;
  return {name, scene, std::move(options)};
}

/// The scene that was found to end the process.
Scene glass_ball() {
  Scene scene = empty_scene(side, side);
  const auto glass = add_material(scene, Glass{});
  scene.spheres = {{{0, 0, 0}, 1, glass}};
  return scene;
}

std::vector<Case> cases() {
  Scene open = mixed_scene(side, side);
  open.camera = ThinLensCamera{{{0.5f, 1.6f, 6}, {0, 0.8f, 0}, {0, 1, 0}}, 50, FovAxis::x, 0.1f};
  RenderOptions lines{{.transparent = true, .outline = 1}, {}};
  RenderOptions in_passes{{.spp = 5}, {}};
  in_passes.order = PixelOrder::progressive;
  lines.aovs = {.depth = true, .id = true, .albedo = true};
  return {picture("glass", glass_ball()),
          picture("mixed", mixed_scene(side, side), {{.spp = 2}, {}}),
          picture("deep", glass_cloud(side, side)),
          picture("lens", open, in_passes),
          picture("path", path_scene(side, side), {{.spp = 3}, {}}),
          picture("lines", mixed_scene(side, side), lines)};
}

class MemoryEnd : public testing::TestWithParam<int> {
 protected:
  /// Of a renderer that has rendered nothing yet.
  static long failures(const Case& one, const Call& call) {
    return failures_of(
        [&](Work& work) { work.renderer = Renderer::create(one.scene, one.options).value(); },
        call);
  }
  [[nodiscard]] static Case param() { return cases()[static_cast<std::size_t>(GetParam())]; }
};

TEST_P(MemoryEnd, OfRender) {
  EXPECT_GT(failures(param(), [](Work& w) { return keep(w.renderer->render(), w.image); }), 20);
}

TEST_P(MemoryEnd, OfRenderPass) {
  const auto call = [](Work& w) {
    return w.renderer->render_pass(w.film, w.renderer->options().spp);
  };
  EXPECT_GT(failures(param(), call), 20);
}

TEST_P(MemoryEnd, OfRenderLive) {
  EXPECT_GT(failures(param(), [](Work& w) { return w.renderer->render_live(w.film); }), 20);
}

TEST_P(MemoryEnd, OfRenderStep) {
  const auto call = [](Work& w) -> Status {
    w.film.restart(w.film.rect());  // after an error it can only begin anew
    LivePosition position;
    while (!w.renderer->done(position)) {
      if (auto done = w.renderer->render_step(w.film, position, {.seconds = 1e9}); !done)
        return done;
    }
    return {};
  };
  EXPECT_GT(failures(param(), call), 20);
}

TEST_P(MemoryEnd, OfRenderBands) {
  const auto call = [](Work& w) {
    w.more.clear();
    return w.renderer->render_bands([&](const Image& band) -> Status {
      add(w.more, band);
      return {};
    });
  };
  EXPECT_GT(failures(param(), call), 20);
}

TEST_P(MemoryEnd, OfWork) {
  const auto call = [](Work& w) {
    return w.renderer->work([&](BlockTools& tools) {
      tools.render(w.film.rect(), w.renderer->options().spp, w.film);
      if (!w.outline) w.outline.emplace(w.film.rect());
      tools.find_lines(w.film.rect(), *w.outline);
    });
  };
  Case one = param();
  one.options.tile = side;
  EXPECT_GT(failures(one, call), 20);
}

TEST_P(MemoryEnd, OfRecordPixel) {
  const auto call = [](Work& w) {
    w.more.resize(1);
    return keep(w.renderer->record_pixel(side / 2, side / 2, w.record), w.more[0]);
  };
  Case one = param();
  one.options.method = Method::whitted;
  EXPECT_GT(failures(one, call), 20);
}

TEST_P(MemoryEnd, OfLinesAndChannels) {
  Case one = param();
  one.options.outline = 1;
  one.options.aovs = {.depth = true, .id = true, .albedo = true};
  EXPECT_GT(failures(one, [](Work& w) { return keep(w.renderer->render_outline(), w.outline); }),
            5);
  EXPECT_GT(failures(one, [](Work& w) { return keep(w.renderer->render_aovs(), w.channels); }), 5);
}

TEST_P(MemoryEnd, OfRenderMeasured) {
  Case one = param();
  one.options.noise = 0.2F;
  one.options.spp = 16;
  one.options.min_spp = 16;
  const auto call = [](Work& w) {
    w.film.restart(w.film.rect());
    return w.renderer->render_measured(w.measured, &w.film);
  };
  EXPECT_GT(failures(one, call), 20);
}

TEST_P(MemoryEnd, OfMakingARenderer) {
  const Case one = param();
  const auto create = [](auto&& scene, const RenderOptions& options, Work& work) -> Status {
    auto renderer = Renderer::create(std::forward<decltype(scene)>(scene), options);
    if (!renderer) return renderer.error();
    work.renderer = std::move(renderer).value();
    return {};
  };
  EXPECT_GT(failures_of([](Work&) {}, [&](Work& w) { return create(one.scene, one.options, w); }),
            20);
  const auto prepared = std::make_shared<const PreparedScene>(
      prepare(one.scene, side, side, serial_for, one.options.method).value());
  EXPECT_GT(failures_of([](Work&) {}, [&](Work& w) { return create(prepared, one.options, w); }),
            2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MemoryEnd, testing::Range(0, 6), [](const auto& test) {
  return cases()[static_cast<std::size_t>(test.param)].name;
});

TEST(MemoryEndOfTracer, OfEveryQuery) {
  for (const Solver solver : {Solver::robust, Solver::reference}) {
    TraceOptions options{.solver = solver, .threads = 1};
    const Scene scene = mixed_scene(side, side);
    const auto make = [&](Work& w) { w.tracer = Tracer::create(scene, options).value(); };
    EXPECT_GT(failures_of(make, [](Work& w) { return w.tracer->closest(w.rays, w.hits); }), 5);
    EXPECT_GT(failures_of(make, [](Work& w) { return w.tracer->any(w.rays, w.met); }), 5);
    const auto of_columns = [](Work& w) {
      w.more.resize(3 * w.rays.size());
      for (TracedHit& hit : w.hits) hit = {};
      std::vector<double>& t = w.columns.t;
      std::vector<std::int32_t>& id = w.columns.id;
      return w.tracer->closest_of_columns(columns(w.rays), {t.data(), id.data(), w.more.data()});
    };
    EXPECT_GT(failures_of(make, of_columns), 5);
    const auto met = [](Work& w) { return w.tracer->any_of_columns(columns(w.rays), w.met); };
    EXPECT_GT(failures_of(make, met), 5);
  }
}

TEST(MemoryEndOfTracer, OfMakingOne) {
  const Scene scene = mixed_scene(side, side);
  const auto call = [&](Work& w) -> Status {
    auto tracer = Tracer::create(scene, {.threads = 1});
    if (!tracer) return tracer.error();
    w.tracer = std::move(tracer).value();
    return {};
  };
  EXPECT_GT(failures_of([](Work&) {}, call), 10);
}

TEST(MemoryEndOfFiles, OfReadingAScene) {
  const TempDir folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  std::ofstream(path("a.toml")) << "schema = 1\n[material.m]\ntype = \"glass\"\n[[sphere]]\n"
                                   "center = [0, 1, 0]\nradius = 2\nmaterial = \"m\"\n";
  std::ofstream(path("a.nff")) << "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\n"
                                  "resolution 8 8\nf 1 0 0 1 0 0 0 1\ns 0 0 0 1\n";
  for (const char* name : {"a.toml", "a.nff"}) {
    const std::string file = path(name);
    const auto call = [&](Work& w) -> Status {
      auto loaded = load_scene(file);
      if (!loaded) return loaded.error();
      w.scene = std::move(loaded).value().scene;
      return {};
    };
    EXPECT_GT(failures_of([](Work&) {}, call), 20) << name;
  }
}

/// Those of other formats, and reading, are up to OpenImageIO, parts of which may not fail.
TEST(MemoryEndOfFiles, OfWritingAPicture) {
  const TempDir folder;
  const Image image(side, side);
  const ImageFileOptions options;
  for (const char* name : {"a.png", "a.ppm"}) {
    const std::string file = (folder.path() / name).string();
    EXPECT_GT(failures_of([](Work&) {}, [&](Work&) { return write_image(image, file, options); }),
              5)
        << name;
    const auto left = std::filesystem::directory_iterator(folder.path());
    for (const auto& entry : left) EXPECT_EQ(entry.path().extension().string().size(), 4U);
  }
}

TEST(MemoryEndOfRenderer, OneThatWasMovedAwayRefuses) {
  const Case one = picture("", glass_ball(), {{.spp = 64}, {.noise = 0.1F}});
  Work w;
  Renderer renderer = Renderer::create(one.scene, one.options).value();
  const Renderer taken = std::move(renderer);
  const std::string words = "the renderer was moved away";
  LivePosition position;
  EXPECT_EQ(renderer.record_pixel(0, 0, w.record).error().message, words);
  EXPECT_EQ(renderer.render().error().message, words);
  EXPECT_EQ(renderer.render_aovs().error().message, words);
  EXPECT_EQ(renderer.render_outline().error().message, words);
  EXPECT_EQ(renderer.render_pass(w.film, 1).error().message, words);
  EXPECT_EQ(renderer.render_live(w.film).error().message, words);
  EXPECT_EQ(renderer.render_step(w.film, position, {}).error().message, words);
  EXPECT_EQ(renderer.render_measured(w.measured).error().message, words);
  EXPECT_EQ(renderer.render_bands([](const Image&) -> Status { return {}; }).error().message,
            words);
  EXPECT_EQ(renderer.work([](BlockTools&) {}).error().message, words);
}

}  // namespace
}  // namespace boule::test
