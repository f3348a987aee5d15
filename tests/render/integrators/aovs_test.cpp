#include "render/integrators/aovs.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr AovSelection everything = {true, true, true, true, true};

/// The channels of a scene's aovs, or a failed test and none.
std::vector<ImageChannel> render_aovs(const Scene& scene, const RenderOptions& options) {
  auto renderer = Renderer::create(scene, options);
  if (renderer) {
    auto channels = renderer.value().render_aovs();
    if (channels) return std::move(channels).value();
    ADD_FAILURE() << format_diagnostic(channels.error());
  } else {
    ADD_FAILURE() << format_diagnostic(renderer.error());
  }
  return {};
}

RenderOptions options_for(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.aovs = everything;
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

/// The aovs of single rays on an instruction set's kernels.
std::vector<Aovs> aovs_of(const Scene& scene, const std::vector<Ray>& rays,
                          const KernelTable& kernels = *select_kernels("auto").value()) {
  const auto prepared = prepare(scene, 8, 8);
  AovTracer finder(prepared.value(), kernels, Solver::robust);
  RayBuffer stream = to_stream(rays);
  std::vector<Aovs> aovs(rays.size());
  finder.trace(stream, Coherence::none, aovs.data());
  EXPECT_EQ(finder.counts().primary, rays.size());
  return aovs;
}

class WideAovs : public OnEachIsa {};

TEST_P(WideAovs, HaveTheReferencesBits) {
  for (const Scene& scene : {mixed_scene(45, 31), glass_cloud(33, 17)}) {
    RenderOptions options = options_for(scene);
    options.isa = GetParam();
    RenderOptions reference = options;
    reference.solver = Solver::reference;
    EXPECT_EQ(difference(render_aovs(scene, options), render_aovs(scene, reference)), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Isa, WideAovs, each_isa(), isa_name);

TEST(Aovs, AreIndependentOfThreadsTilesOrderSamples) {
  const Scene scene = mixed_scene(45, 31);
  const auto expected = render_aovs(scene, options_for(scene));
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
      EXPECT_EQ(difference(render_aovs(scene, options), expected), "") << threads << " " << tile;
    }
  }
}

TEST(Aovs, OfACropEqualTheFramesPart) {
  const Scene scene = mixed_scene(45, 31);
  RenderOptions options = options_for(scene);
  const auto frame = render_aovs(scene, options);
  options.crop = PixelRect{11, 5, 40, 23};
  const auto crop = render_aovs(scene, options);
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

TEST(Aovs, OnlySelectedOnesAreMade) {
  const Scene scene = mixed_scene(5, 4);
  const auto names = [&](const AovSelection& aovs) {
    RenderOptions options = options_of(scene);
    options.aovs = aovs;
    std::string all;
    for (const ImageChannel& channel : render_aovs(scene, options)) all += channel.name + " ";
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

TEST(Aovs, CountTheirRaysAndMemory) {
  const Scene scene = mixed_scene(5, 4);
  auto renderer = Renderer::create(scene, options_for(scene));
  ASSERT_TRUE(renderer);
  ASSERT_TRUE(renderer.value().render_aovs());
  EXPECT_EQ(renderer.value().statistics().rays.total(), 20u);
  EXPECT_GT(renderer.value().statistics().render_seconds, 0);
  const PixelRect rect{0, 0, 5, 4};
  EXPECT_EQ(AovChannels::bytes(everything, rect), 20u * 11u * 4u);
  EXPECT_EQ(AovChannels::bytes({}, rect), 0u);
}

TEST(Aovs, CancellingIsAnError) {
  const Scene scene = mixed_scene(45, 31);
  const std::atomic<bool> cancel{true};
  RenderOptions options = options_for(scene);
  options.cancel = &cancel;
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  EXPECT_FALSE(renderer.value().render_aovs());
}

TEST(Aovs, DepthIsEuclideanWhateverTheDirectionsLength) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, -10}, 1, 0}};
  for (const float length : {0.25f, 1.0f, 1000.0f}) {
    const Aovs aov = aovs_of(scene, {{{0, 0, 0}, {0, 0, -length}}})[0];
    EXPECT_EQ(aov.depth, 9.0f);
    EXPECT_EQ(aov.position, (Vec3f{0, 0, -9}));
    EXPECT_EQ(aov.normal, (Vec3f{0, 0, 1}));
    EXPECT_EQ(aov.id, 0u);
  }
}

TEST(Aovs, ZIsTheDistanceAlongTheView) {
  Scene scene = empty_scene(8, 8);  // from (0, 0, 5) along -z
  add_material(scene, Matte{});
  scene.planes = {{{0, 0, -4}, {0, 0, 1}, 0}, {{0, 0, 8}, {0, 0, 1}, 0}};
  const auto aovs = aovs_of(
      scene, {{{0, 0, 5}, {0, 0, -1}}, {{0, 0, 5}, {0.6f, 0, -0.8f}}, {{0, 0, 5}, {0, 0, 1}}});
  EXPECT_EQ(aovs[0].along, 9.0f);
  EXPECT_EQ(aovs[0].depth, 9.0f);
  EXPECT_NEAR(aovs[1].along, 9, 1e-6);
  EXPECT_NEAR(aovs[1].depth, 9 / 0.8, 1e-5);
  EXPECT_EQ(aovs[2].along, -3.0f);  // behind the eye
  const Aovs miss = aovs_of(empty_scene(8, 8), {{{0, 0, 0}, {0, 1, 0}}})[0];
  EXPECT_EQ(miss.along, std::numeric_limits<float>::infinity());
  EXPECT_EQ(AovChannels::names({false, false, false, false, false, true}),
            std::vector<std::string>{"view.Z"});
}

TEST(Aovs, NormalsAreTurnedTowardsTheViewer) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 0, 0}, 2, 0}};
  scene.planes = {{{0, -5, 0}, {0, 3, 0}, 0}};
  const auto aovs = aovs_of(scene, {{{0, 0, 0}, {1, 0, 0}},        // from inside the sphere
                                    {{9, 0, 0}, {0, -1, 0}},       // onto the plane's front
                                    {{9, -9, 0}, {0, 0.5f, 0}}});  // and onto its back
  EXPECT_EQ(aovs[0].normal, (Vec3f{-1, 0, 0}));
  EXPECT_EQ(aovs[1].normal, (Vec3f{0, 1, 0}));
  EXPECT_EQ(aovs[1].id, 1u);
  EXPECT_EQ(aovs[2].normal, (Vec3f{0, -1, 0}));
  EXPECT_EQ(aovs[2].depth, 4.0f);
}

TEST(Aovs, AMissIsMarked) {
  const Aovs aov = aovs_of(empty_scene(8, 8), {{{0, 0, 0}, {0, 1, 0}}})[0];
  EXPECT_EQ(aov.depth, std::numeric_limits<float>::infinity());
  EXPECT_EQ(aov.normal, Vec3f{});
  EXPECT_EQ(aov.position, Vec3f{});
  EXPECT_EQ(aov.id, 4294967295u);
  EXPECT_EQ(aov.albedo, Color{});
}

TEST(Aovs, ADistanceBeyondFloatStaysFinite) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.planes = {{{0, 0, -3e38f}, {0, 0, 1}, 0}};
  const Aovs aov = aovs_of(scene, {{{0, 0, 3e38}, {0, 0, -2}}})[0];
  EXPECT_EQ(aov.depth, std::numeric_limits<float>::max());
  EXPECT_EQ(aov.position.z, -3e38f);
}

TEST(Aovs, AlbedoIsTheReflectedShareOfLight) {
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
    const Aovs aov = aovs_of(scene, {{{0, 0.5, 0}, {0, 0, -1}}})[0];
    EXPECT_EQ(aov.albedo, c.albedo) << "material " << &c - cases;
  }
}

}  // namespace
}  // namespace boule::test
