#include "render/integrators/views.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/test_scenes.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr ViewSelection everything = {true, true, true, true, true};

/// The channels of a scene's views, or a failed test and none.
std::vector<ImageChannel> render_views(const Scene& scene, const RenderOptions& options) {
  auto renderer = Renderer::create(scene, options);
  if (renderer) {
    auto channels = renderer.value().render_views();
    if (channels) return std::move(channels).value();
    ADD_FAILURE() << format_diagnostic(channels.error());
  } else {
    ADD_FAILURE() << format_diagnostic(renderer.error());
  }
  return {};
}

RenderOptions options_for(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.views = everything;
  return options;
}

/// Bits of a channel's sample.
std::uint32_t bits(const ImageChannel& channel, std::size_t pixel) {
  if (const auto* ids = std::get_if<std::vector<std::uint32_t>>(&channel.samples)) {
    return (*ids)[pixel];
  }
  return std::bit_cast<std::uint32_t>(std::get<std::vector<float>>(channel.samples)[pixel]);
}

std::size_t size_of(const ImageChannel& channel) {
  return std::visit([](const auto& samples) { return samples.size(); }, channel.samples);
}

/// The first channel that differs in any bit, or an empty text.
std::string difference(const std::vector<ImageChannel>& a, const std::vector<ImageChannel>& b) {
  if (a.size() != b.size()) return "number of channels";
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (a[c].name != b[c].name || size_of(a[c]) != size_of(b[c])) return a[c].name;
    for (std::size_t i = 0; i < size_of(a[c]); ++i) {
      if (bits(a[c], i) != bits(b[c], i)) return a[c].name + " of pixel " + std::to_string(i);
    }
  }
  return {};
}

/// The views of single rays on an instruction set's kernels.
std::vector<View> views_of(const Scene& scene, const std::vector<Ray>& rays,
                           const KernelTable& kernels = *select_kernels("auto").value()) {
  const auto prepared = prepare(scene, 8, 8);
  Views finder(prepared.value(), kernels, Solver::robust);
  RayBuffer stream = to_stream(rays);
  std::vector<View> views(rays.size());
  finder.trace(stream, Coherence::none, views.data());
  EXPECT_EQ(finder.counts().primary, rays.size());
  return views;
}

class WideViews : public OnEachIsa {};

TEST_P(WideViews, HaveTheReferencesBits) {
  for (const Scene& scene : {mixed_scene(45, 31), glass_cloud(33, 17)}) {
    RenderOptions options = options_for(scene);
    options.isa = GetParam();
    RenderOptions reference = options;
    reference.solver = Solver::reference;
    EXPECT_EQ(difference(render_views(scene, options), render_views(scene, reference)), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Isa, WideViews, each_isa(), isa_name);

TEST(Views, DoNotDependOnThreadsTilesOrderOrSamples) {
  const Scene scene = mixed_scene(45, 31);
  const auto expected = render_views(scene, options_for(scene));
  ASSERT_EQ(expected.size(), 11u);
  ASSERT_EQ(size_of(expected[0]), 45u * 31u);
  for (const unsigned threads : {1u, 2u, 5u}) {
    for (const int tile : {1, 7, 64}) {
      RenderOptions options = options_for(scene);
      options.threads = threads;
      options.tile = tile;
      options.spp = tile;
      options.seed = threads;
      options.order = tile == 7 ? PixelOrder::frameless : PixelOrder::rows;
      EXPECT_EQ(difference(render_views(scene, options), expected), "") << threads << " " << tile;
    }
  }
}

TEST(Views, OfACropAreThatPartOfTheFrames) {
  const Scene scene = mixed_scene(45, 31);
  RenderOptions options = options_for(scene);
  const auto frame = render_views(scene, options);
  options.crop = PixelRect{11, 5, 40, 23};
  const auto crop = render_views(scene, options);
  ASSERT_EQ(crop.size(), frame.size());
  for (std::size_t c = 0; c < crop.size(); ++c) {
    ASSERT_EQ(size_of(crop[c]), 29u * 18u);
    for (std::size_t y = 0; y < 18; ++y) {
      for (std::size_t x = 0; x < 29; ++x) {
        ASSERT_EQ(bits(crop[c], y * 29 + x), bits(frame[c], (y + 5) * 45 + x + 11)) << crop[c].name;
      }
    }
  }
}

TEST(Views, OnlyTheSelectedOnesAreMade) {
  const Scene scene = mixed_scene(5, 4);
  const auto names = [&](const ViewSelection& views) {
    RenderOptions options = options_of(scene);
    options.views = views;
    std::string all;
    for (const ImageChannel& channel : render_views(scene, options)) all += channel.name + " ";
    return all;
  };
  EXPECT_EQ(names({}), "");
  EXPECT_EQ(names({true, false, false, false, false}), "Z ");
  EXPECT_EQ(names({false, true, false, false, false}), "N.X N.Y N.Z ");
  EXPECT_EQ(names({false, false, true, false, false}), "P.X P.Y P.Z ");
  EXPECT_EQ(names({false, false, false, true, false}), "id ");
  EXPECT_EQ(names({false, false, false, false, true}), "albedo.R albedo.G albedo.B ");
  EXPECT_EQ(names(everything), "Z N.X N.Y N.Z P.X P.Y P.Z id albedo.R albedo.G albedo.B ");
}

TEST(Views, TheirRaysAreCountedAndTheirMemoryIsAskedFor) {
  const Scene scene = mixed_scene(5, 4);
  auto renderer = Renderer::create(scene, options_for(scene));
  ASSERT_TRUE(renderer);
  ASSERT_TRUE(renderer.value().render_views());
  EXPECT_EQ(renderer.value().statistics().rays.total(), 20u);
  EXPECT_GT(renderer.value().statistics().render_seconds, 0);
  const PixelRect rect{0, 0, 5, 4};
  EXPECT_EQ(ViewChannels::bytes(everything, rect), 20u * 11u * 4u);
  EXPECT_EQ(ViewChannels::bytes({}, rect), 0u);
}

TEST(Views, CancelledTheyAreAnError) {
  const Scene scene = mixed_scene(45, 31);
  const std::atomic<bool> cancel{true};
  RenderOptions options = options_for(scene);
  options.cancel = &cancel;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  EXPECT_FALSE(renderer.value().render_views());
}

TEST(Views, DepthIsEuclideanWhateverTheDirectionsLength) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, -10}, 1, 0}};
  for (const float length : {0.25f, 1.0f, 1000.0f}) {
    const View view = views_of(scene, {{{0, 0, 0}, {0, 0, -length}}})[0];
    EXPECT_EQ(view.depth, 9.0f);
    EXPECT_EQ(view.position, (Vec3f{0, 0, -9}));
    EXPECT_EQ(view.normal, (Vec3f{0, 0, 1}));
    EXPECT_EQ(view.id, 0u);
  }
}

TEST(Views, ZIsTheDistanceAlongTheView) {
  Scene scene = empty_scene(8, 8);  // from (0, 0, 5) along -z
  add_material(scene, Matte{});
  scene.planes = {{{0, 0, -4}, {0, 0, 1}, 0}, {{0, 0, 8}, {0, 0, 1}, 0}};
  const auto views = views_of(
      scene, {{{0, 0, 5}, {0, 0, -1}}, {{0, 0, 5}, {0.6f, 0, -0.8f}}, {{0, 0, 5}, {0, 0, 1}}});
  EXPECT_EQ(views[0].along, 9.0f);
  EXPECT_EQ(views[0].depth, 9.0f);
  EXPECT_NEAR(views[1].along, 9, 1e-6);
  EXPECT_NEAR(views[1].depth, 9 / 0.8, 1e-5);
  EXPECT_EQ(views[2].along, -3.0f);  // behind the eye
  const View miss = views_of(empty_scene(8, 8), {{{0, 0, 0}, {0, 1, 0}}})[0];
  EXPECT_EQ(miss.along, std::numeric_limits<float>::infinity());
  EXPECT_EQ(ViewChannels::names({false, false, false, false, false, true}),
            std::vector<std::string>{"view.Z"});
}

TEST(Views, NormalsAreTurnedTowardsTheViewer) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 2, 0}};
  scene.planes = {{{0, -5, 0}, {0, 3, 0}, 0}};
  const auto views = views_of(scene, {{{0, 0, 0}, {1, 0, 0}},        // from inside the sphere
                                      {{9, 0, 0}, {0, -1, 0}},       // onto the plane's front
                                      {{9, -9, 0}, {0, 0.5f, 0}}});  // and onto its back
  EXPECT_EQ(views[0].normal, (Vec3f{-1, 0, 0}));
  EXPECT_EQ(views[1].normal, (Vec3f{0, 1, 0}));
  EXPECT_EQ(views[1].id, 1u);
  EXPECT_EQ(views[2].normal, (Vec3f{0, -1, 0}));
  EXPECT_EQ(views[2].depth, 4.0f);
}

TEST(Views, AMissIsMarked) {
  const View view = views_of(empty_scene(8, 8), {{{0, 0, 0}, {0, 1, 0}}})[0];
  EXPECT_EQ(view.depth, std::numeric_limits<float>::infinity());
  EXPECT_EQ(view.normal, Vec3f{});
  EXPECT_EQ(view.position, Vec3f{});
  EXPECT_EQ(view.id, 4294967295u);
  EXPECT_EQ(view.albedo, Color{});
}

TEST(Views, ADistanceBeyondFloatStaysFinite) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.planes = {{{0, 0, -3e38f}, {0, 0, 1}, 0}};
  const View view = views_of(scene, {{{0, 0, 3e38}, {0, 0, -2}}})[0];
  EXPECT_EQ(view.depth, std::numeric_limits<float>::max());
  EXPECT_EQ(view.position.z, -3e38f);
}

TEST(Views, AlbedoIsTheShareOfLightThatGoesOn) {
  struct Case {
    Material material;
    Color albedo;
  };
  const Case cases[] = {
      {Matte{{0.1f, 0.2f, 0.3f}}, {0.1f, 0.2f, 0.3f}},
      {Plastic{{0.25f, 0.5f, 1}, 0.5f, 50, 0.25f}, {0.5f, 0.75f, 1}},  // highlights are not in it
      {Metal{{0.9f, 0.8f, 0.7f}}, {0.9f, 0.8f, 0.7f}},
      {Glass{{1, 1, 1}, 1.5f}, {1, 1, 1}},
      {Emissive{{3, 4, 5}}, {0, 0, 0}},
      {Phong{{0.5f, 0.25f, 0}, 0.5f, 0.5f, 0.125f, 20, 0.25f, 1.5f}, {0.625f, 0.5f, 0.375f}},
  };
  for (const Case& c : cases) {
    Scene scene = empty_scene(8, 8);
    scene.ambient = {1, 1, 1};  // not in it either
    add_material(scene, c.material);
    scene.spheres = {{{0, 0, -10}, 1, 0}};
    const View view = views_of(scene, {{{0, 0.5, 0}, {0, 0, -1}}})[0];
    EXPECT_EQ(view.albedo, c.albedo) << "material " << &c - cases;
  }
}

}  // namespace
}  // namespace boule::test
