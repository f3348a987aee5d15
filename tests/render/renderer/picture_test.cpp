#include <gtest/gtest.h>

#include "tests/render/picture_comparison.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// A picture of odd size with several samples and every feature, which all pictures below must
/// equal.
const Scene& scene() {
  static const Scene s = [] {
    Scene mixed = mixed_scene(53, 37);
    mixed.image.spp = 3;
    return mixed;
  }();
  return s;
}
const Image& expected() {
  static const Image image = render(scene());
  return image;
}

class PictureOfIsa : public OnEachIsa {};

TEST_P(PictureOfIsa, IsTheSame) {
  RenderOptions options = options_of(scene());
  options.isa = GetParam();
  EXPECT_EQ(differing_pixels(render(scene(), options), expected()), 0);
  const Scene glass = glass_cloud(32, 32);
  RenderOptions glass_options = options_of(glass);
  glass_options.isa = GetParam();
  EXPECT_EQ(differing_pixels(render(glass, glass_options), render(glass)), 0);
}

INSTANTIATE_TEST_SUITE_P(All, PictureOfIsa, each_isa(), isa_name);

TEST(Picture, IsTheSameFromTheReferencePath) {
  RenderOptions options = options_of(scene());
  options.solver = Solver::reference;
  EXPECT_EQ(differing_pixels(render(scene(), options), expected()), 0);
}

TEST(Picture, IgnoresTheThreadCount) {
  for (const unsigned threads : {1u, 2u, 7u}) {
    RenderOptions options = options_of(scene());
    options.threads = threads;
    EXPECT_EQ(differing_pixels(render(scene(), options), expected()), 0) << threads;
  }
}

TEST(Picture, IgnoresTileSizeAndOrder) {
  for (const int tile : {1, 2, 3, 8, 15, 16, 31, 64}) {
    for (const PixelOrder order :
         {PixelOrder::rows, PixelOrder::tiles, PixelOrder::progressive, PixelOrder::frameless}) {
      RenderOptions options = options_of(scene());
      options.tile = tile;
      options.order = order;
      EXPECT_EQ(differing_pixels(render(scene(), options), expected()), 0)
          << tile << " " << static_cast<int>(order);
    }
  }
}

TEST(Picture, CropsEqualTheFramesPart) {
  for (const PixelRect& crop : {PixelRect{0, 0, 53, 37}, PixelRect{17, 5, 18, 6},
                                PixelRect{10, 11, 40, 29}, PixelRect{52, 0, 53, 37}}) {
    RenderOptions options = options_of(scene());
    options.crop = crop;
    const Image image = render(scene(), options);
    ASSERT_EQ(image.width, crop.width());
    ASSERT_EQ(image.height, crop.height());
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        ASSERT_TRUE(same_bits(image.at(x, y), expected().at(x + crop.x0, y + crop.y0)));
      }
    }
  }
}

TEST(Picture, TheSkyIsOnTop) {
  Scene sky = empty_scene(8, 8);
  sky.background = GradientBackground{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  const Image image = render(sky);
  EXPECT_GT(image.at(3, 0).b, image.at(3, 7).b);
  EXPECT_LT(image.at(3, 0).r, image.at(3, 7).r);
  for (int y = 1; y < 8; ++y) EXPECT_LT(image.at(0, y).b, image.at(0, y - 1).b);
}

TEST(Picture, XGrowsToTheRight) {
  Scene right = empty_scene(9, 3);
  right.spheres = {{{1.5f, 0, 0}, 0.5f, add_material(right, Emissive{})}};
  const Image image = render(right);
  float left_half = 0, right_half = 0;
  for (int x = 0; x < 4; ++x) left_half += image.at(x, 1).r, right_half += image.at(8 - x, 1).r;
  EXPECT_EQ(left_half, 0);
  EXPECT_GT(right_half, 0);
}

TEST(Picture, PixelCentresAreTheLectures) {
  // 4 x 4 pixels over -1..1, with centres at -.75, -.25, .25, .75 on a film at distance 1. Tiny
  // lamps are exactly there.
  Scene slide = empty_scene(4, 4);
  slide.camera = pinhole({0, 0, 0}, {0, 0, -1}, 90);
  const auto lamp = add_material(slide, Emissive{gray(1)});
  struct Place {
    float x, y;
    int column, row;
  };
  for (const Place& p : {Place{-0.75f, -0.75f, 0, 3}, Place{-0.25f, 0.25f, 1, 1}}) {
    slide.spheres = {{{p.x, p.y, -1}, 1e-4f, lamp}};
    const Image image = render(slide);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        EXPECT_EQ(image.at(x, y), gray(x == p.column && y == p.row ? 1 : 0)) << x << " " << y;
      }
    }
  }
}

TEST(Picture, WithoutCameraAndLightIsNotBlack) {
  Scene bare;
  bare.image = {40, 30, 1};
  bare.spheres = {{{100, 7, -30}, 5, add_material(bare, Matte{})}, {{104, 9, -33}, 2, 0}};
  int lit = 0;
  for (const Color& c : render(bare).pixels) lit += c.r > 0 ? 1 : 0;
  EXPECT_GT(lit, 200);
}

TEST(Picture, OfAnEmptySceneIsTheBackground) {
  Scene nothing;
  nothing.image = {5, 4, 2};
  nothing.background = ConstantBackground{{0.25f, 0.5f, 2}};
  const Image image = render(nothing);
  ASSERT_EQ(image.pixels.size(), 20u);
  for (const Color& c : image.pixels) EXPECT_EQ(c, (Color{0.25f, 0.5f, 2}));
}

TEST(Picture, ManySamplesSmoothAnEdge) {
  Scene edge = empty_scene(9, 9);
  edge.spheres = {{{0, 0, 0}, 1, add_material(edge, Emissive{})}};
  RenderOptions options = options_of(edge);
  options.spp = 16;
  const Image smooth = render(edge, options);
  int partly = 0;
  for (const Color& c : smooth.pixels) partly += c.r > 0 && c.r < 1 ? 1 : 0;
  EXPECT_GT(partly, 8);
  options.seed = 1;
  EXPECT_GT(differing_pixels(render(edge, options), smooth), 0);
}

}  // namespace
}  // namespace boule::test
