// The settings of the caller's floating-point unit change nothing that the library makes, and the
// library leaves them as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "core/math/srgb.h"
#include "render/files/scene_file/scene_file.h"
#include "render/files/trace_file/ray_file.h"
#include "render/frame/partial_picture.h"
#include "render/image/read_image.h"
#include "render/image/tone.h"
#include "render/image/write_image.h"
#include "render/prepare/default_camera.h"
#include "render/renderer/scene_hash.h"
#include "render/renderer/tracer.h"
#include "tests/render/npy_files.h"
#include "tests/render/path_scenes.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/file_bytes.h"
#include "tests/support/odd_float_environment.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

class CallersFloatEnvironment : public testing::TestWithParam<Oddity> {
 protected:
  /// Calls `make` under the oddity, which must still be there afterwards.
  template <class Make>
  static auto oddly(const Make& make) {
    bool stayed = false;
    auto made = [&] {
      const OddFloatEnvironment odd(GetParam());
      auto result = make();
      stayed = odd.holds();
      return result;
    }();
    EXPECT_TRUE(stayed);
    return made;
  }

  std::string write(const std::string& name, const std::string& text) const {
    write_bytes(folder_.path() / name, text);
    return (folder_.path() / name).string();
  }
  std::string read(const std::string& name) const { return read_bytes(folder_.path() / name); }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  TempDir folder_;
};

/// A scene whose numbers are rounded at every step: rotated instances, a lens, several samples.
Scene rounding_scene(Scene scene) {
  scene.image.spp = 3;
  scene.image.filter = PixelFilter::tent;
  scene.camera =
      ThinLensCamera{{{0.5f, 1.6f, 6}, {0, 0.8f, 0}, {0.1f, 1, 0}}, 50.1f, FovAxis::x, 0.05f};
  scene.groups = {{"pair", {{{0.1f, 0, 0}, 0.13f, 0}, {{-0.1f, 0.2f, 0}, 0.07f, 1}}, {}, {}}};
  for (int i = 0; i < 40; ++i) {
    const auto x = static_cast<float>(i);
    scene.instances.push_back({0, {0.1f * x - 2, 0.3f, 2.3f}, {x * 7, x * 11, 3}, 0.3f, {}});
  }
  return scene;
}

Scene scene_of(Method method) {
  Scene scene = rounding_scene(method == Method::path ? path_scene(24, 16) : mixed_scene(24, 16));
  scene.render.method = method;
  return scene;
}

RenderOptions options_for(const Scene& scene, unsigned threads) {
  RenderOptions options = options_of(scene);
  options.threads = threads;
  options.tile = 8;
  options.order = PixelOrder::progressive;
  return options;
}

/// The pictures that all ways of rendering make.
struct Pictures {
  Image whole, passes, live, halfway;
  std::vector<ImageChannel> aovs;
  std::uint64_t hash;
};

Pictures make_pictures(const Scene& scene, RenderOptions options) {
  Pictures made;
  made.hash = scene_hash(scene);
  options.aovs = {true, true, true, true, true};
  int updates = 0;
  options.update = [&](const Film& film) {
    if (++updates == 2) made.halfway = partial_picture(film, options.order);
  };
  auto renderer = Renderer::create(scene, options);
  made.whole = renderer.value().render().value();
  Film passes(renderer.value().rect()), live(renderer.value().rect());
  for (const int until : {1, 3}) static_cast<void>(renderer.value().render_pass(passes, until));
  made.passes = passes.to_image();
  static_cast<void>(renderer.value().render_live(live));
  made.live = live.to_image();
  made.aovs = renderer.value().render_aovs().value();
  return made;
}

TEST_P(CallersFloatEnvironment, ChangesNoPicture) {
  for (const Method method : {Method::whitted, Method::path}) {
    const Scene scene = scene_of(method);
    for (const unsigned threads : {1u, 3u}) {
      const RenderOptions options = options_for(scene, threads);
      const Pictures odd = oddly([&] { return make_pictures(scene, options); });
      const Pictures expected = make_pictures(scene, options);
      EXPECT_EQ(odd.hash, expected.hash);
      EXPECT_EQ(differing_pixels(odd.whole, expected.whole), 0);
      EXPECT_EQ(differing_pixels(odd.passes, expected.whole), 0);
      EXPECT_EQ(differing_pixels(odd.live, expected.whole), 0);
      EXPECT_EQ(differing_pixels(odd.halfway, expected.halfway), 0);
      ASSERT_EQ(odd.aovs.size(), expected.aovs.size());
      for (std::size_t i = 0; i < odd.aovs.size(); ++i)
        EXPECT_EQ(odd.aovs[i].samples, expected.aovs[i].samples) << odd.aovs[i].name;
    }
  }
}

/// The settings of the threads that a caller lends change nothing either.
TEST_P(CallersFloatEnvironment, OfLentThreadsChangesNoCamera) {
  Scene scene;
  for (int i = 1; i <= 500; ++i) {
    const auto x = static_cast<float>(i);
    scene.spheres.push_back({{7.7f / x, 0.13f * x, 1.1f - x / 3}, 0.3f / x, 0});
  }
  scene.fit.direction = {0.3f, -0.7f, -1.1f};
  const ParallelFor odd_threads = [](std::size_t count, const auto& body) {
    const OddFloatEnvironment odd(GetParam());
    for (std::size_t i = 0; i < count; ++i) body(i);
  };
  const Camera camera = default_camera(scene, 640, 479, odd_threads);
  scene.camera = camera;
  const std::uint64_t hash = scene_hash(scene);
  scene.camera = std::nullopt;
  scene.camera = default_camera(scene, 640, 479);
  EXPECT_EQ(hash, scene_hash(scene));
}

/// A lens of real elements and an environment image, each of which is prepared by code of its own.
TEST_P(CallersFloatEnvironment, ChangesNoPreparation) {
  Scene scene = scene_of(Method::path);
  scene.camera = LensCamera{{{0.5f, 1.6f, 6}, {0, 0.8f, 0}, {0, 1, 0}},
                            {{29.5f, 6.3f, 1.61f, 25}, {0, 4, 1, 18}, {-81, 1.9f, 1.7f, 18}}};
  EnvironmentBackground surroundings{8, 4, std::vector<Color>(32, {0.1f, 0.2f, 0.3f}), 33.3f};
  surroundings.pixels[9] = {7.7f, 5.1f, 3.3f};
  scene.background = surroundings;
  const RenderOptions options = options_for(scene, 2);
  const auto make = [&] { return Renderer::create(scene, options).value().render().value(); };
  const Image odd = oddly(make);
  EXPECT_EQ(differing_pixels(odd, make()), 0);
}

TEST_P(CallersFloatEnvironment, ChangesNoSceneThatIsRead) {
  write("cloud.npy", sphere_file({{{0.1f, 0.2f, 1e-41f}, 0.3f, 0}, {{5, 6, 7}, 1e-40f, 0}}));
  const std::string toml = write("scene.toml", R"(schema = 1
[camera]
eye = [0.1, 1.123456789, 6.7]
look_at = [0.0, 1.0000001, 1e-40]
[[light]]
position = [16777217.0, 0.3, 0.7]
[material.paint]
color = [0.1, 0.2, 0.3]
[[sphere]]
center = [1e-42, 0.1, 16777219]
radius = 0.7
material = "paint"
[[spheres]]
file = "cloud.npy"
[group.pair]
[[group.pair.sphere]]
center = [0.1, 0.2, 0.3]
[[instance]]
group = "pair"
rotate = [10, 20, 30]
scale = 0.1
)");
  const std::string nff = write("scene.nff",
                                "v\nfrom 0.1 0.2 5.3\nat 0 0 0\nup 0 1 0\nangle 45.1\n"
                                "hither 1\nresolution 8 8\nl 0.1 4.7 3.3\nl 1 2 3\n"
                                "f 0.1 0.2 0.3 0.4 0.5 3.3 0 1\ns 0.1 0.2 0.3 1e-42\n");
  for (const std::string& file : {toml, nff}) {
    const auto odd = oddly([&] { return load_scene(file); });
    ASSERT_TRUE(odd) << odd.error().message;
    EXPECT_EQ(scene_hash(odd.value().scene), scene_hash(load_scene(file).value().scene));
  }
}

TEST_P(CallersFloatEnvironment, ChangesNoFile) {
  Image image(5, 4);
  float x = 0.01f;
  for (Color& c : image.pixels) c = {x *= 1.13f, x * 1e-41f, 1 - x};
  ImageFileOptions options;
  options.exposure_stops = 0.3f;
  options.threads = 2;
  for (const std::string extension : {"exr", "png", "jpg", "hdr"}) {
    const std::string odd = "odd." + extension, plain = "plain." + extension;
    // Outside of the odd environment: joining paths raises the inexact flag.
    const std::string odd_path = path(odd), plain_path = path(plain);
    EXPECT_TRUE(oddly([&] { return write_image(image, odd_path, options); }));
    ASSERT_TRUE(write_image(image, plain_path, options));
    EXPECT_EQ(read(odd), read(plain)) << extension;
    const auto content = PictureContent::colors;
    const auto found = oddly([&] { return read_image(plain_path, content); });
    EXPECT_EQ(differing_pixels(found.value(), read_image(plain_path, content).value()), 0);
  }
}

/// The first picture in the process makes the table that later ones use.
TEST_P(CallersFloatEnvironment, ChangesNoToneCurve) {
  Image ramp(256, 1);
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<float>(linear_from_srgb((i - 0.5) / 255));
    ramp.at(i, 0) = {value, value, value};
  }
  const auto odd = oddly([&] { return tone_map(ramp, 0); });
  EXPECT_EQ(odd, tone_map(ramp, 0));
  for (std::size_t i = 1; i < 256; ++i) {
    const float value = ramp.pixels[i].r;
    const double exact = linear_from_srgb((static_cast<double>(i) - 0.5) / 255);
    const int above = static_cast<double>(value) >= exact ? 0 : 1;
    EXPECT_EQ(odd[3 * i] + above, static_cast<int>(i));
  }
}

/// Numbers so small that everything computed from them is denormal.
Scene tiny(Scene scene) {
  for (Sphere& s : scene.spheres) s = {s.center * 0x1p-133f, s.radius * 0x1p-133f, 0};
  for (Plane& p : scene.planes) p.point = p.point * 0x1p-133f;
  return scene;
}
std::vector<Ray> tiny(std::vector<Ray> rays) {
  for (std::size_t i = 0; i < rays.size(); i += 2) rays[i].dir = rays[i].dir * 0x1p-133f;
  for (Ray& ray : rays) ray.org = ray.org * 0x1p-133;
  return rays;
}

struct Hits {
  std::vector<TracedHit> closest;
  std::vector<std::uint8_t> met;
};

TEST_P(CallersFloatEnvironment, ChangesNoHit) {
  const Scene cloud = objects(sphere_cloud(200), {{{0, -9, 0}, {0.1f, 1, 0}, 0}});
  const std::string shape = "(3000, 8)";
  for (const bool small : {false, true}) {
    const Scene scene = small ? tiny(cloud) : cloud;
    const std::vector<Ray> rays = small ? tiny(ray_cloud(3000)) : ray_cloud(3000);
    const std::string file = write("rays.npy", npy_file(npy_dict("'<f4'", shape), ray_rows(rays)));
    for (const Solver solver : {Solver::fast, Solver::robust, Solver::reference}) {
      const auto make = [&] {
        auto opened = RayFile::open(file);
        std::vector<Ray> found(rays.size());
        static_cast<void>(opened.value().read(found));
        TraceOptions options;
        options.threads = 2;
        options.solver = solver;
        auto tracer = Tracer::create(scene, options);
        Hits hits{std::vector<TracedHit>(found.size()), std::vector<std::uint8_t>(found.size())};
        static_cast<void>(tracer.value().closest(found, hits.closest));
        static_cast<void>(tracer.value().any(found, hits.met));
        return hits;
      };
      const Hits odd = oddly(make), expected = make();
      EXPECT_EQ(differing_hits(odd.closest, expected.closest), 0);
      EXPECT_EQ(odd.met, expected.met);
      EXPECT_GT(std::count(odd.met.begin(), odd.met.end(), 1), 300);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Oddities, CallersFloatEnvironment, testing::ValuesIn(oddities),
                         [](const auto& oddity) { return name_of(oddity.param); });

}  // namespace
}  // namespace boule::test
