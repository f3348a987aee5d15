// Adaptive antialiasing: the same bits however it is rendered, and of which samples.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "render/prepare/prepared_scene.h"
#include "render/renderer/renderer.h"
#include "render/renderer/small_spheres.h"
#include "tests/render/renderer/measured_pictures.h"

namespace boule::test::edges {
namespace {

constexpr int width = 150, height = 110;

/// Balls of glass, metal and matte on a floor.
Scene scene_of_edges() {
  Scene scene;
  scene.image = {.width = width, .height = height};
  scene.camera = PinholeCamera{{{0, 2, 7}, {0, 0.6F, 0}, {0, 1, 0}}, 45, FovAxis::x};
  scene.background = ConstantBackground{{0.3F, 0.5F, 0.8F}};
  scene.materials = {{"matte", Matte{{0.8F, 0.3F, 0.2F}}},
                     {"glass", Glass{}},
                     {"metal", Metal{{0.9F, 0.8F, 0.5F}}}};
  const auto of = [](std::uint32_t material) { return MaterialRef(material); };
  scene.spheres = {{{-1.6F, 0.8F, 0}, 0.8F, of(0)},
                   {{0.1F, 0.7F, 1}, 0.7F, of(1)},
                   {{1.8F, 0.9F, -0.5F}, 0.9F, of(2)}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, of(0)}};
  scene.lights = {PointLight{{4, 6, 5}, {1, 1, 1}}};
  return scene;
}

RenderOptions options_with(float aa) {
  RenderOptions options = options_of(scene_of_edges());
  options.aa = aa;
  options.spp = 64;
  options.threads = 2;
  return options;
}

double mean_samples(const MeasuredPicture& picture) {
  return noise_reached(picture, 64).mean_samples;
}

TEST(Edges, IgnoreThreadsTilesAndOrders) {
  const Scene scene = scene_of_edges();
  const std::uint64_t expected = hash_of(measured(scene, options_with(8)));
  for (const int tile : {1, 7, 64, 128, 1024}) {
    RenderOptions other = options_with(8);
    other.tile = tile;
    other.threads = tile == 7 ? 1 : 5;
    other.order = tile == 64 ? PixelOrder::frameless : PixelOrder::rows;
    EXPECT_EQ(hash_of(measured(scene, other)), expected) << tile;
  }
}

TEST(Edges, CropsEqualThePicturesPart) {
  const Scene scene = scene_of_edges();
  RenderOptions options = options_with(8);
  const MeasuredPicture whole = measured(scene, options);
  for (const PixelRect& crop : {PixelRect{33, 20, 120, 71}, PixelRect{149, 109, 150, 110}}) {
    options.crop = crop;
    EXPECT_EQ(hash_of(measured(scene, options)), hash_of(whole, crop));
  }
}

TEST(Edges, AllWaysToRenderAgree) {
  const Scene scene = scene_of_edges();
  RenderOptions options = options_with(8);
  options.tile = 32;
  const Image expected = measured(scene, options).image(Alpha::none);
  Renderer renderer = Renderer::create(scene, options).value();
  EXPECT_EQ(renderer.render().value().pixels, expected.pixels);
  std::vector<Color> rows;
  EXPECT_TRUE(renderer.render_bands([&rows](const Image& band) -> Status {
    rows.insert(rows.end(), band.pixels.begin(), band.pixels.end());
    return {};
  }));
  EXPECT_EQ(rows, expected.pixels);
}

/// Whatever the filter.
TEST(Edges, PixelsEqualThoseOfUniformPictures) {
  const Scene scene = scene_of_edges();
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::tent}) {
    RenderOptions options = options_with(8);
    options.filter = filter;
    const MeasuredPicture picture = measured(scene, options);
    std::map<std::uint32_t, Image> uniform;
    options.least_weight = left_out_weight(options);
    options.aa = 0;
    std::size_t i = 0;
    for (const MeasuredPixel& pixel : picture.pixels()) {
      if (!uniform.contains(pixel.samples)) {
        options.spp = static_cast<int>(pixel.samples);
        uniform[pixel.samples] = Renderer::create(scene, options).value().render().value();
      }
      ASSERT_EQ(pixel.color, uniform[pixel.samples].pixels[i++]);
    }
    std::set<std::uint32_t> counts;
    for (const auto& [samples, image] : uniform) counts.insert(samples);
    EXPECT_EQ(counts, (std::set<std::uint32_t>{1, 4, 8, 16, 32, 64}));
  }
}

TEST(Edges, LeaveOutASixteenthOfAStep) {
  RenderOptions options = options_with(8);
  EXPECT_EQ(left_out_weight(options), 8.0F / 255 / 16);
  options.least_weight = 0.01F;
  EXPECT_EQ(left_out_weight(options), 0.01F);
  options.aa = 0;
  options.least_weight = 0;
  EXPECT_EQ(left_out_weight(options), 0);
}

/// The mean of the largest channel's displayed errors.
double error_beside(const Image& image, const Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Color &a = image.pixels[i], &b = reference.pixels[i];
    const double error =
        std::max({std::fabs(srgb_displayed(double{a.r}) - srgb_displayed(double{b.r})),
                  std::fabs(srgb_displayed(double{a.g}) - srgb_displayed(double{b.g})),
                  std::fabs(srgb_displayed(double{a.b}) - srgb_displayed(double{b.b}))});
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(image.pixels.size()));
}

TEST(Edges, FewSamplesAreWorthManyEverywhere) {
  const Scene scene = scene_of_edges();
  RenderOptions options = options_with(8);
  const MeasuredPicture picture = measured(scene, options);
  options.aa = 0;
  options.spp = 512;
  options.seed = 9;
  const Image reference = Renderer::create(scene, options).value().render().value();
  options.spp = 12;
  options.seed = 0;
  const Image uniform = Renderer::create(scene, options).value().render().value();
  EXPECT_LT(mean_samples(picture), 5);
  EXPECT_LT(error_beside(picture.image(Alpha::none), reference), error_beside(uniform, reference));
}

TEST(Edges, SmallerStepsTakeMoreSamples) {
  const Scene scene = scene_of_edges();
  const double coarse = mean_samples(measured(scene, options_with(32))),
               usual = mean_samples(measured(scene, options_with(8))),
               fine = mean_samples(measured(scene, options_with(2)));
  EXPECT_LT(1, coarse);
  EXPECT_LT(coarse, usual);
  EXPECT_LT(usual, fine);
  RenderOptions few = options_with(2);
  few.spp = 6;
  const MeasuredPicture picture = measured(scene, few);
  for (const MeasuredPixel& pixel : picture.pixels()) EXPECT_LE(pixel.samples, 6U);
}

TEST(Edges, PlainPicturesHaveOneSample) {
  Scene scene = scene_of_edges();
  scene.spheres.clear();
  scene.planes.clear();
  const MeasuredPicture picture = measured(scene, options_with(1));
  for (const MeasuredPixel& pixel : picture.pixels()) EXPECT_EQ(pixel.samples, 1U);
}

TEST(Edges, AlphaHasEdgesToo) {
  Scene scene = scene_of_edges();
  scene.planes.clear();
  scene.materials[0].material = Emissive{{0, 0, 0}};  // black before black
  scene.spheres.resize(1);
  RenderOptions options = options_with(8);
  options.transparent = true;
  double parts = 0;
  const MeasuredPicture picture = measured(scene, options);
  for (const MeasuredPixel& pixel : picture.pixels())
    parts += pixel.alpha > 0 && pixel.alpha < 1 ? 1 : 0;
  EXPECT_GT(parts, 60);
}

/// Stars of half a pixel, most of which the rays through the centres miss.
TEST(Edges, SmallSpheresStayInThePicture) {
  Scene scene = scene_of_edges();
  scene.background = ConstantBackground{{0, 0, 0}};
  scene.materials[0].material = Emissive{{1, 1, 1}};
  scene.spheres.clear();
  scene.planes.clear();
  const MaterialRef film(scene.materials.size());
  scene.materials.push_back({"film", Ghost{{1, 1, 1}, 0.5F}});
  for (const Camera& camera :
       {Camera(PinholeCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 90, FovAxis::x}),
        Camera(OrthographicCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 15}),
        Camera(FisheyeCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 120, FovAxis::x})}) {
    scene.camera = camera;
    scene.spheres.clear();
    for (int i = 0; i < 100; ++i) {
      const auto x = static_cast<float>(i % 10) - 4.47F, y = static_cast<float>(i / 10) - 4.53F;
      scene.spheres.push_back({{x, y * 0.7F, -9}, 0.03F, i % 3 == 0 ? film : MaterialRef(0)});
    }
    RenderOptions options = options_with(8);
    const MeasuredPicture picture = measured(scene, options);
    const PreparedScene prepared = prepare(scene, width, height).value();
    const SmallSpheres small(prepared, width, picture.rect(), serial_for);
    options.aa = 0;
    options.spp = 256;
    const Image reference = Renderer::create(scene, options).value().render().value();
    int marked = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool seen = reference.pixels[reference.index(x, y)].r > 0;
        marked += small.may_hide(x, y) ? 1 : 0;
        if (seen) EXPECT_TRUE(small.may_hide(x, y)) << x << ' ' << y;
        if (small.may_hide(x, y)) EXPECT_GE(picture.at(x, y).samples, 16U);
      }
    }
    EXPECT_GE(marked, 100);
    EXPECT_LE(marked, 900);
  }
}

TEST(Edges, RefuseWhatTheyAreNotFor) {
  Scene scene = scene_of_edges();
  const auto error_of = [&](const auto& change) {
    RenderOptions options = options_with(8);
    change(options);
    const auto renderer = Renderer::create(scene, options);
    return renderer ? std::string() : renderer.error().key + " " + renderer.error().message;
  };
  EXPECT_EQ(error_of([](RenderOptions&) {}), "");
  EXPECT_NE(error_of([](RenderOptions& o) { o.aa = -1; }), "");
  EXPECT_NE(error_of([](RenderOptions& o) { o.least_weight = 2; }), "");
  EXPECT_EQ(error_of([](RenderOptions& o) { o.method = Method::path; }),
            "render.aa is for method whitted: where paths have noise, ask for noise");
  EXPECT_EQ(error_of([](RenderOptions& o) { o.noise = 0.1F; }),
            "render.aa cannot stand beside noise: choose one, 0 is none");
  scene.camera = ThinLensCamera{{{0, 2, 7}, {0, 0, 0}, {0, 1, 0}}, 45, FovAxis::x, 0.1F};
  EXPECT_EQ(error_of([](RenderOptions&) {}),
            "render.aa is for cameras without a lens: where it blurs, ask for noise");
}

TEST(Edges, ChoicesReplaceEachOther) {
  RenderOptions options = options_with(8);
  choose_samples({.spp = 4}, options);
  EXPECT_EQ(options.aa, 0);
  EXPECT_EQ(options.spp, 4);
  choose_samples({.aa = 5.0F}, options);
  EXPECT_EQ(options.aa, 5);
  EXPECT_EQ(options.spp, usual_max_edge_spp);
  choose_samples({.noise = 0.1F}, options);
  EXPECT_EQ(options.aa, 0);
  EXPECT_EQ(options.noise, 0.1F);
  choose_samples({.spp = 9, .aa = 5.0F}, options);
  EXPECT_EQ(options.noise, 0);
  EXPECT_EQ(options.spp, 9);
}

/// Glass in glass, where rays split again and again.
TEST(LeastWeight, BoundsTheLightLeftOut) {
  Scene scene = scene_of_edges();
  for (const float radius : {0.6F, 0.5F, 0.4F})
    scene.spheres.push_back({{0.1F, 0.7F, 1}, radius, MaterialRef(1)});
  scene.lights.clear();
  scene.background = ConstantBackground{{1, 1, 1}};
  scene.ambient = {1, 1, 1};  // no radiance above 1
  RenderOptions options = options_of(scene);
  options.max_depth = 12;
  Renderer all = Renderer::create(scene, options).value();
  const Image reference = all.render().value();
  std::uint64_t rays = all.statistics().rays.total();
  for (const float weight : {0.001F, 0.01F, 0.1F}) {
    options.least_weight = weight;
    Renderer fewer = Renderer::create(scene, options).value();
    const Image image = fewer.render().value();
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      EXPECT_LE(image.pixels[i].r, reference.pixels[i].r + 1e-5F);
      EXPECT_GE(image.pixels[i].r, reference.pixels[i].r - weight - 1e-5F);
    }
    EXPECT_LT(fewer.statistics().rays.total(), rays);
    rays = fewer.statistics().rays.total();
    RenderOptions other = options;
    other.tile = 3;
    other.threads = 3;
    EXPECT_EQ(Renderer::create(scene, other).value().render().value().pixels, image.pixels);
  }
}

}  // namespace
}  // namespace boule::test::edges
