// Pictures of every camera: their bits do not depend on how the work is done, and they show what
// they should.
#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/camera_samples.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

const CameraPose pose{{0.5f, 1.6f, 6}, {0, 0.8f, 0}, {0, 1, 0}};

struct CameraCase {
  const char* name;
  Camera camera;
  bool distorted = false;
};

std::ostream& operator<<(std::ostream& out, const CameraCase& c) { return out << c.name; }

class Cameras : public testing::TestWithParam<CameraCase> {
 protected:
  static Scene scene() {
    Scene scene = mixed_scene(53, 37);
    scene.camera = GetParam().camera;
    scene.image.spp = 3;
    if (GetParam().distorted) scene.distortion = random_map(6, 5, 0.05);
    return scene;
  }
};

TEST_P(Cameras, SameBitsOnEveryIsa) {
  RenderOptions options = options_of(scene());
  options.isa = "scalar";
  const Image expected = render(scene(), options);
  for (const IsaInfo& isa : list_isas()) {
    if (!isa.supported) continue;
    options.isa = isa.name;
    EXPECT_EQ(differing_pixels(render(scene(), options), expected), 0) << isa.name;
  }
  options.solver = Solver::reference;
  EXPECT_EQ(differing_pixels(render(scene(), options), expected), 0);
}

TEST_P(Cameras, BitsIgnoreThePartitionOfWork) {
  const Image expected = render(scene());
  for (const int tile : {1, 7, 64}) {
    for (const PixelOrder order : {PixelOrder::rows, PixelOrder::frameless}) {
      RenderOptions options = options_of(scene());
      options.tile = tile;
      options.order = order;
      options.threads = 3;
      EXPECT_EQ(differing_pixels(render(scene(), options), expected), 0) << tile;
    }
  }
  RenderOptions options = options_of(scene());
  options.crop = PixelRect{5, 3, 20, 30};
  const Image part = render(scene(), options);
  expect_crop_of(expected, part, 5, 3);
}

TEST_P(Cameras, PathsIgnoreThePartitionOfWork) {
  Scene traced = scene();
  traced.render.method = Method::path;
  const Image expected = render(traced);
  RenderOptions options = options_of(traced);
  options.tile = 1;  // streams of one pixel, some of them without a ray
  EXPECT_EQ(differing_pixels(render(traced, options), expected), 0);
}

/// A lens with two equal faces; from the focus to the film are about five units.
LensCamera magnifier() {
  LensCamera camera{pose, {{20, 4, 1.5f, 12}, {-20, 0, 1, 12}}, 24, 0.1f};
  camera.focus = 4.5f;
  return camera;
}

std::string name_of(const testing::TestParamInfo<CameraCase>& tested) { return tested.param.name; }

const CameraCase cameras[] = {
    {"fisheye", FisheyeCamera{pose, 180, FovAxis::x}},
    {"fisheye_all_round", FisheyeCamera{pose, 360, FovAxis::y}},
    {"thin_lens", ThinLensCamera{pose, 50, FovAxis::x, 0.2f, 4.5f}},
    {"lens", magnifier()},
    {"distorted_lens", magnifier(), true},
    {"distorted_pinhole", PinholeCamera{pose, 50, FovAxis::x}, true},
    {"distorted_orthographic", OrthographicCamera{pose, 5}, true},
    {"distorted_fisheye", FisheyeCamera{pose, 300, FovAxis::y}, true},
    {"distorted_thin_lens", ThinLensCamera{pose, 50, FovAxis::x, 0.2f, 4.5f}, true},
};
INSTANTIATE_TEST_SUITE_P(Every, Cameras, testing::ValuesIn(cameras), name_of);

TEST(Fisheye, OutsideTheCircleIsBlackWithoutRays) {
  Scene scene = empty_scene(60, 30);
  scene.background = ConstantBackground{gray(1)};
  scene.camera = FisheyeCamera{pose, 360, FovAxis::y};
  auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_TRUE(renderer);
  const auto image = renderer.value().render();
  ASSERT_TRUE(image);
  std::uint64_t lit = 0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 60; ++x) {
      const bool inside = std::hypot(x + 0.5 - 30, y + 0.5 - 15) <= 15;
      EXPECT_EQ(image.value().at(x, y), gray(inside ? 1 : 0)) << x << " " << y;
      lit += inside ? 1 : 0;
    }
  }
  EXPECT_EQ(renderer.value().statistics().rays.primary, lit);
}

TEST(Fisheye, SeesWhatIsBehindIt) {
  Scene scene = empty_scene(31, 31);
  scene.camera = FisheyeCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 360, FovAxis::x};
  const auto lamp = add_material(scene, Emissive{gray(1)});
  scene.spheres = {{{0, 0, 5}, 4, lamp}};  // asin(4/5) = 53 degrees around straight back
  const Image image = render(scene);
  for (int x = 0; x < 31; ++x) {
    const double degrees = std::fabs(x - 15) / 15.5 * 180;
    EXPECT_EQ(image.at(x, 15), gray(degrees > 180 - 53.13 ? 1 : 0)) << x;
  }
}

TEST(ThinLens, ViewsAreThoseOfThePinhole) {
  Scene scene = mixed_scene(40, 24);
  RenderOptions options = options_of(scene);
  options.aovs.position = options.aovs.id = options.aovs.depth = true;
  const auto views_of = [&](const Camera& camera) {
    scene.camera = camera;
    return Renderer::create(scene, options).value().render_aovs().value();
  };
  const auto expected = views_of(PinholeCamera{pose, 50, FovAxis::x});
  const auto found = views_of(ThinLensCamera{pose, 50, FovAxis::x, 0.5f, 3.0f});
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].samples, expected[i].samples);
}

TEST(ThinLens, BlursWhatIsOutOfFocusOnly) {
  // A lamp so small that a pinhole shows it in one of 63 pixels.
  Scene scene = empty_scene(63, 63);
  scene.image.spp = 512;
  const auto lamp = add_material(scene, Emissive{gray(1)});
  scene.spheres = {{{0, 0, -5}, 0.03f, lamp}};
  const auto lit_pixels = [&](float focus) {
    const CameraPose ahead{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    scene.camera = ThinLensCamera{ahead, 60, FovAxis::x, 0.5f, focus};
    const Image image = render(scene);
    int lit = 0;
    for (const Color& c : image.pixels) lit += c.r > 0 ? 1 : 0;
    return lit;
  };
  EXPECT_EQ(lit_pixels(5), 1);
  // Out of focus: a disc of radius 0.5 (1/2.5 - 1/5) = 0.1, on a film 2 tan 30 = 1.15 wide: 5.5 of
  // 63 pixels, or 94 pixels in all. The lamp covers a third of a pixel, which spreads over them: in
  // each pixel 1.8 of the 512 samples meet it on average, and in one of six none does.
  EXPECT_GT(lit_pixels(2.5f), 60);
  EXPECT_LT(lit_pixels(2.5f), 125);
}

TEST(Lens, IsTheRightWayUp) {
  // A lamp to the upper left of the point that is looked at.
  Scene scene = empty_scene(32, 32);
  LensCamera camera = magnifier();
  camera.pose = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  camera.focus = 5.0f;
  scene.camera = camera;
  scene.image.spp = 16;
  scene.spheres = {{{-0.8f, 0.8f, 0}, 0.5f, add_material(scene, Emissive{gray(1)})}};
  const Image image = render(scene);
  float sums[2][2] = {};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) sums[y / 16][x / 16] += image.at(x, y).r;
  }
  EXPECT_GT(sums[0][0], 1);
  EXPECT_LT(sums[0][1] + sums[1][0] + sums[1][1], 0.05f * sums[0][0]);
}

TEST(Lens, StoppedRaysCostNothing) {
  Scene scene = empty_scene(32, 32);
  scene.camera = magnifier();
  scene.image.spp = 16;
  auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_TRUE(renderer);
  ASSERT_TRUE(renderer.value().render());
  const std::uint64_t rays = renderer.value().statistics().rays.primary;
  EXPECT_LT(rays, 32U * 32 * 16 * 95 / 100);  // a disc covers 79 percent of a square
  EXPECT_GT(rays, 32U * 32 * 16 / 4);
}

TEST(Distortion, MirrorsThePictureIfTheMapDoes) {
  Scene scene = mixed_scene(40, 24);
  const Image expected = render(scene);
  scene.distortion = DistortionMap{2, 2, {0.75f, 0.75f, 0.25f, 0.75f, 0.75f, 0.25f, 0.25f, 0.25f}};
  const Image mirrored = render(scene);
  int same = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      const Color a = expected.at(x, y), b = mirrored.at(39 - x, y);
      same += std::fabs(a.r - b.r) < 1e-3f && std::fabs(a.g - b.g) < 1e-3f ? 1 : 0;
    }
  }
  EXPECT_GT(same, 940);  // of 960: rays that touch a rim may differ
}

}  // namespace
}  // namespace boule::test
