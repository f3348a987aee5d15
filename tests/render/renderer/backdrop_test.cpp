// What is behind the objects: a backdrop that only the camera sees, and alpha.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/frame/partial_picture.h"
#include "render/renderer/scene_hash.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr Color backdrop{0.25f, 0.5f, 0.75f};

class Behind : public testing::TestWithParam<Method> {
 protected:
  /// A mirror, glass and a matte ball under a constant background, and much of that to be seen.
  Behind() {
    scene_ = empty_scene(48, 40);
    scene_.background = ConstantBackground{{0.8f, 0.7f, 0.6f}};
    const auto metal = add_material(scene_, Metal{{1, 1, 1}});
    const auto glass = add_material(scene_, Glass{});
    const auto matte = add_material(scene_, Matte{{0.5f, 0.4f, 0.3f}});
    scene_.spheres = {
        {{-1, 0.8f, 0}, 0.7f, metal}, {{1, 0.7f, 0}, 0.7f, glass}, {{0, -1, 0}, 0.8f, matte}};
    scene_.lights = {PointLight{{3, 5, 4}}};
    scene_.render.method = GetParam();
    scene_.image.spp = 4;
  }

  Scene scene_;
};

/// Whether the pixel has nothing but the color c.
bool is_only(const Color& pixel, const Color& c) { return same_bits(pixel, c); }

TEST_P(Behind, TheCameraAloneSeesTheBackdrop) {
  scene_.image.spp = 1;
  const Image plain = render(scene_);
  scene_.backdrop = backdrop;
  const Image picture = render(scene_);
  int behind = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    const bool is_behind = is_only(picture.pixels[i], backdrop);
    behind += is_behind ? 1 : 0;
    EXPECT_TRUE(is_behind || same_bits(picture.pixels[i], plain.pixels[i])) << i;
  }
  EXPECT_GT(behind, 200);
  EXPECT_EQ(differing_pixels(picture, plain), behind);
}

TEST_P(Behind, AlphaIsTheShareOfHits) {
  const Image plain = render(scene_);
  EXPECT_TRUE(plain.alpha.empty());
  scene_.image.transparent = true;
  const Image picture = render(scene_);
  scene_.image.transparent = false;
  scene_.backdrop = Color{};
  EXPECT_EQ(differing_pixels(picture, render(scene_)), 0);  // premultiplied
  scene_.background = ConstantBackground{};
  scene_.backdrop = gray(1);
  scene_.materials.assign(3, {"black", Matte{{0, 0, 0}}});
  const Image uncovered = render(scene_);  // shows how much of each pixel is not covered
  ASSERT_EQ(picture.alpha.size(), picture.pixels.size());
  int partly = 0;
  for (std::size_t i = 0; i < picture.alpha.size(); ++i) {
    EXPECT_EQ(picture.alpha[i], 1 - uncovered.pixels[i].r) << i;
    partly += picture.alpha[i] > 0 && picture.alpha[i] < 1 ? 1 : 0;
  }
  EXPECT_GT(partly, 30);
}

TEST_P(Behind, AlphaIgnoresThreadsTilesAndIsa) {
  scene_.image.transparent = true;
  expect_picture_of_all_isas(scene_, render(scene_));
}

TEST_P(Behind, AlphaIgnoresThePixelOrder) {
  scene_.image.transparent = true;
  RenderOptions options = options_of(scene_);
  const Image picture = render(scene_, options);
  options.order = PixelOrder::progressive;
  auto renderer = Renderer::create(scene_, options);
  ASSERT_TRUE(renderer);
  Film film(renderer.value().rect());
  ASSERT_TRUE(renderer.value().render_live(film));
  EXPECT_EQ(film.to_image(Alpha::coverage).alpha, picture.alpha);
  EXPECT_EQ(partial_picture(film, options.order, Alpha::coverage).alpha, picture.alpha);
  EXPECT_TRUE(film.to_image().alpha.empty());
}

TEST_P(Behind, APixelWithoutSamplesTakesAnothersAlpha) {
  Film film({0, 0, 4, 1});
  film.add(0, 0, gray(0.5f), whole_coverage);
  film.add(0, 0, {}, 0);
  const Image partial = partial_picture(film, PixelOrder::frameless, Alpha::coverage);
  EXPECT_EQ(partial.alpha, (std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(film.to_image(Alpha::coverage).alpha, (std::vector<float>{0.5f, 0, 0, 0}));
}

/// Samples that no ray of the lens reaches are covered by nothing.
TEST_P(Behind, AlphaIsZeroWhereCamerasSeeNothing) {
  FisheyeCamera fisheye;
  fisheye.pose = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  fisheye.fov = 360;
  scene_.camera = fisheye;
  scene_.planes = {{{0, -3, 0}, {0, 1, 0}, 0}};
  scene_.image.transparent = true;
  const Image picture = render(scene_);
  EXPECT_EQ(picture.alpha[0], 0);
  EXPECT_EQ(picture.pixels[0], Color{});
  EXPECT_GT(*std::max_element(picture.alpha.begin(), picture.alpha.end()), 0.9f);
}

INSTANTIATE_TEST_SUITE_P(Methods, Behind, testing::Values(Method::whitted, Method::path),
                         [](const auto& method) { return std::string(name_of(method.param)); });

TEST(Backdrop, PresenceAndColorChangeTheHash) {
  Scene scene = mixed_scene(8, 8);
  const std::uint64_t none = scene_hash(scene);
  scene.backdrop = Color{};
  const std::uint64_t black = scene_hash(scene);
  scene.backdrop = backdrop;
  EXPECT_NE(none, black);
  EXPECT_NE(none, scene_hash(scene));
  EXPECT_NE(black, scene_hash(scene));
}

TEST(Backdrop, IsCheckedWithTheScene) {
  Scene scene = mixed_scene(8, 8);
  scene.backdrop = Color{0, -1, 0};
  const Status done = validate(scene);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "background.backdrop");
}

}  // namespace
}  // namespace boule::test
