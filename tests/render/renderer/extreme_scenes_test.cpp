// Scenes of extreme but legal values: every pixel and every AOV is a number, and the same on every
// instruction set, and the scenes that should be visible are visible.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr float huge = 3e38F, denormal = 1e-40F;

struct Extreme {
  std::string name;
  std::function<void(Scene&)> make;  ///< of a small picture with a camera at (0, 0, 5)
  bool shows = true;                 ///< something of it is not black
};
std::ostream& operator<<(std::ostream& out, const Extreme& extreme) { return out << extreme.name; }

void light_from(Scene& scene, const Vec3f& position, float intensity = 1,
                Falloff falloff = Falloff::none) {
  scene.lights.emplace_back(PointLight{position, {intensity, intensity, intensity}, falloff});
}

const Extreme extremes[] = {
    {"FarCoordinates",
     [](Scene& s) {
       s.spheres = {{{huge, huge, -huge}, 1, 0}, {{-huge, 0, 0}, huge, 0}, {{0, 0, 0}, 1, 0}};
       light_from(s, {huge, huge, huge});
     }},
    {"FarCamera",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1e37F, 0}};
       s.camera = pinhole({0, 0, huge}, {0, 0, 0}, 10);
       light_from(s, {0, 0, huge});
     }},
    {"HugeRadius",
     [](Scene& s) {
       s.spheres = {{{0, -1e38F, 0}, 1e38F, 0}};
       light_from(s, {0, 5, 0});
     }},
    {"InsideAHugeSphere",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, huge, 0}};
       light_from(s, {0, 0, 5});
     }},
    {"DenormalSizes",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, denormal, 0}, {{denormal, -denormal, 0}, 1e-45F, 0}};
       s.camera = pinhole({0, 0, 1e-38F}, {0, 0, 0}, 45);
       light_from(s, {denormal, denormal, 1e-38F});
     },
     false},
    {"LightOnASurface",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1, 0}};
       light_from(s, {0, 0, 1});
       light_from(s, {0, 0, 1}, 1, Falloff::inverse_square);
     },
     false},
    {"LightInACentre",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1, 0}, {{0, 0, -9}, 2, 0}};
       light_from(s, {0, 0, 0}, 1, Falloff::inverse_square);
     },
     false},
    {"LightAtTheEye",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1, 0}};
       light_from(s, {0, 0, 5}, huge, Falloff::inverse_square);
     }},
    {"ManyGreatLights",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1, 0}};
       for (int i = 0; i < 8; ++i) light_from(s, {0, 1, 5}, huge);
     }},
    {"SharpestHighlight",
     [](Scene& s) {
       add_material(s, Phong{{1, 1, 1}, 0, 1, 1, 1e30F, 0, 1});
       s.spheres = {{{0, 0, 0}, 1, 1}};
       light_from(s, {0, 0, 5});
     }},
    {"DenormalShininess",
     [](Scene& s) {
       add_material(s, Phong{{1, 1, 1}, 0, 1, huge, denormal, 0, 1});
       s.spheres = {{{0, 0, 0}, 1, 1}};
       light_from(s, {0, 3, 5});
     }},
    {"GreatestShares",
     [](Scene& s) {
       add_material(s, Phong{{huge, 1, huge}, huge, huge, huge, 10, huge, 1.5F});
       s.spheres = {{{0, 0, 0}, 1, 1}};
       s.background = ConstantBackground{{1, 1, 1}};
       s.ambient = {huge, huge, huge};
       light_from(s, {0, 3, 5});
     }},
    {"GreatAndSmallIndices",
     [](Scene& s) {
       add_material(s, Glass{{1, 1, 1}, huge});
       add_material(s, Glass{{huge, 1, 1}, denormal});
       s.spheres = {{{-1, 0, 0}, 1, 1}, {{1, 0, 0}, 1, 2}, {{0, 0, -9}, 2, 0}};
       light_from(s, {0, 3, 5});
     }},
    {"MirrorsThatAmplify",
     [](Scene& s) {
       add_material(s, Phong{{1, 1, 1}, 0, 1, 1e20F, 0, 1e20F, 1.5F});
       s.spheres = {{{-1, 0, 0}, 1, 1}, {{1, 0, 0}, 1, 1}};
       s.planes = {{{0, -1, 0}, {0, 1, 0}, 1}};
       light_from(s, {0, 3, 5});
     }},
    {"IdenticalSpheres",
     [](Scene& s) {
       s.spheres.assign(20000, {{0, 0, 0}, 1, 0});
       light_from(s, {0, 3, 5});
     }},
    {"CollinearSpheres",
     [](Scene& s) {
       for (int i = 0; i < 20000; ++i)
         s.spheres.push_back({{0, 0, -0.001F * static_cast<float>(i)}, 1, 0});
       light_from(s, {0, 3, 5});
     }},
    {"SpheresInEachOther",
     [](Scene& s) {
       add_material(s, Glass{});
       float radius = 1;
       for (int i = 0; i < 500; ++i, radius *= 0.99F) s.spheres.push_back({{0, 0, 0}, radius, 1});
       s.planes = {{{0, -1, 0}, {0, 1, 0}, 0}};
       light_from(s, {0, 3, 5});
     }},
    {"PlanesEdgeOn",
     [](Scene& s) {
       s.planes = {{{0, 0, 0}, {0, 1, 0}, 0}, {{0, 0, 5}, {1, 0, 0}, 0}};
       s.camera = pinhole({0, 0, 5}, {0, 0, 0}, 45);
       light_from(s, {0, 3, 5});
     },
     false},
    {"PlanesOfAnySize",
     [](Scene& s) {
       s.planes = {{{0, -huge, 0}, {0, huge, 0}, 0},
                   {{0, -1, 0}, {0, denormal, denormal}, 0},
                   {{huge, huge, -huge}, {-1, -1, 1e-30F}, 0}};
       light_from(s, {0, 3, 5});
     }},
    {"NarrowestView",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1, 0}};
       s.camera = pinhole({0, 0, 5}, {0, 0, 0}, denormal);
       light_from(s, {0, 3, 5});
     }},
    {"WidestView",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 6, 0}};
       s.camera = pinhole({0, 0, 5}, {0, 0, 0}, 179.99999F);
       light_from(s, {0, 3, 5});
     }},
    {"GreatestOrthographicView",
     [](Scene& s) {
       s.spheres = {{{0, 0, 0}, 1e38F, 0}};
       s.camera = OrthographicCamera{{{0, 0, huge}, {0, 0, 0}, {0, 1, 0}}, huge};
       light_from(s, {0, 0, huge});
     }},
    {"GreatestBackground",
     [](Scene& s) {
       s.background = GradientBackground{{huge, huge, huge}, {huge, 0, huge}, {0, denormal, 0}};
       add_material(s, Metal{{huge, huge, huge}});
       s.spheres = {{{0, 0, 0}, 1, 1}};
     }},
};

class ExtremeScenes : public testing::TestWithParam<Extreme> {};

bool is_light(float x) { return x >= 0 && x <= std::numeric_limits<float>::max(); }

TEST_P(ExtremeScenes, HaveNumbersInEveryPixel) {
  Scene scene = empty_scene(32, 24);
  scene.image.spp = 2;
  add_material(scene, Matte{});
  GetParam().make(scene);
  ASSERT_TRUE(validate(scene)) << format_diagnostic(validate(scene).error());
  for (const Method method : {Method::whitted, Method::path}) {
    Image first;
    for (const IsaInfo& isa : list_isas()) {
      if (!isa.supported) continue;
      const std::string what = std::string(isa.name) + (method == Method::path ? ", path" : "");
      RenderOptions options = options_of(scene);
      options.method = method;
      options.isa = isa.name;
      const Image image = render(scene, options);
      ASSERT_EQ(image.pixels.size(), 32u * 24u);
      float brightest = 0;
      for (const Color& c : image.pixels) {
        ASSERT_TRUE(is_light(c.r) && is_light(c.g) && is_light(c.b))
            << what << ": " << c.r << " " << c.g << " " << c.b;
        brightest = std::max({brightest, c.r, c.g, c.b});
      }
      EXPECT_TRUE(brightest > 0 || !GetParam().shows) << what;
      if (first.pixels.empty()) first = image;
      EXPECT_EQ(differing_pixels(image, first), 0) << what;
    }
  }
}

/// A picture with one sample per pixel, and what was wrong with its samples.
struct Judged {
  Image image;
  SampleFaults faults;
};
Judged judge(const Scene& scene) {
  auto renderer = Renderer::create(scene, options_of(scene));
  if (!renderer) return {};
  const auto image = renderer.value().render();
  return {image ? image.value() : Image{}, renderer.value().statistics().faults};
}

TEST_P(ExtremeScenes, TellWhatNoFloatHolds) {
  Scene scene = empty_scene(32, 24);
  add_material(scene, Matte{});
  GetParam().make(scene);
  const auto [image, faults] = judge(scene);
  ASSERT_EQ(image.pixels.size(), 32u * 24u);
  constexpr float largest = std::numeric_limits<float>::max();
  const auto brightest = static_cast<std::uint64_t>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](const Color& c) {
        return std::max({c.r, c.g, c.b}) == largest;
      }));
  EXPECT_EQ(faults.too_bright, brightest);
  const auto black =
      static_cast<std::uint64_t>(std::count_if(image.pixels.begin(), image.pixels.end(), is_black));
  EXPECT_LE(faults.not_finite, black);
}

TEST_P(ExtremeScenes, HaveViewsThatAreNumbers) {
  Scene scene = empty_scene(16, 12);
  add_material(scene, Matte{});
  GetParam().make(scene);
  RenderOptions options = options_of(scene);
  options.aovs = {true, true, true, true, true};
  auto renderer = Renderer::create(scene, options);
  ASSERT_TRUE(renderer);
  const auto channels = renderer.value().render_aovs();
  ASSERT_TRUE(channels);
  EXPECT_GT(channels.value().size(), 9u);
  for (const ImageChannel& channel : channels.value()) {
    if (channel.name == "id") continue;
    const auto& samples = std::get<std::vector<float>>(channel.samples);
    for (const float x : samples) {
      const bool distance = channel.name == "Z";  // which is infinite for a miss
      ASSERT_TRUE(distance ? x >= 0 : std::isfinite(x)) << channel.name << " " << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Legal, ExtremeScenes, testing::ValuesIn(extremes),
                         [](const auto& extreme) { return extreme.param.name; });

}  // namespace
}  // namespace boule::test
