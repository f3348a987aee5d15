// Fog: against a blend by the depths of a search of its own.
#include "render/prepare/fog.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/frame/partial_picture.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr Color mist{0.25f, 0.5f, 0.75f};

class FogTest : public testing::TestWithParam<Method> {
 protected:
  /// Balls and a rod from near to far, one of them a mirror, before a backdrop.
  FogTest() {
    scene_ = empty_scene(60, 44);
    const auto matte = add_material(scene_, Matte{{0.5f, 0.4f, 0.3f}});
    const auto metal = add_material(scene_, Metal{{1, 1, 1}});
    scene_.spheres = {{{-1, 0.5f, 1}, 0.5f, matte}, {{1, 0, -2}, 0.9f, metal}};
    scene_.capsules = {{{-1, -1, 0}, {1.5f, -1, -4}, 0.3f, matte}};
    scene_.background = ConstantBackground{{0.8f, 0.7f, 0.6f}};
    scene_.backdrop = mist;
    scene_.lights = {PointLight{{3, 5, 4}}};
    scene_.render.method = GetParam();
  }

  /// The depth along the view at which the centre of each pixel meets something; else infinity.
  [[nodiscard]] std::vector<double> depths() const {
    const ImageSettings& image = scene_.image;
    const CameraView view = build_camera(*scene_.camera, image.width, image.height);
    std::vector<double> depths;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Ray ray = primary_ray(view, x + 0.5, y + 0.5);
        const Hit hit = reference::closest_hit(ray, scene_.spheres, scene_.planes, scene_.capsules);
        const Vec3d point = ray.org + vec_cast<double>(ray.dir) * hit.t;
        depths.push_back(hit.id == no_primitive ? std::numeric_limits<double>::infinity()
                                                : dot(point - view.eye, view.forward));
      }
    }
    return depths;
  }

  Scene scene_;
};

TEST_P(FogTest, BlendsByTheDepth) {
  const Image plain = render(scene_);
  scene_.image.fog = 0.6f;
  scene_.image.fog_from = 2;
  scene_.image.fog_to = 7;
  const Image foggy = render(scene_);
  const std::vector<double> all = depths();
  int changed = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double part = std::isinf(all[i]) ? 0 : std::clamp((all[i] - 2) / 5, 0.0, 1.0);
    const auto f = static_cast<float>(static_cast<double>(0.6f) * part);
    const Color expected = f > 0 ? plain.pixels[i] * (1 - f) + mist * f : plain.pixels[i];
    EXPECT_LT(distance(foggy.pixels[i], {expected.r, expected.g, expected.b}), 1e-5) << i;
    changed += f > 0 ? 1 : 0;
  }
  EXPECT_EQ(differing_pixels(plain, foggy), changed);
  EXPECT_GT(changed, 300);
}

TEST_P(FogTest, FadesAlpha) {
  scene_.image.transparent = true;
  const Image plain = render(scene_);
  scene_.image.fog = 0.5f;
  scene_.image.fog_from = 0;
  scene_.image.fog_to = 8;
  const Image foggy = render(scene_);
  const std::vector<double> all = depths();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double seen = 1 - 0.5 * std::clamp(all[i] / 8, 0.0, 1.0);
    EXPECT_NEAR(foggy.alpha[i], double{plain.alpha[i]} * seen, 0.5 / 255 + 1e-5) << i;
    EXPECT_NEAR(foggy.pixels[i].g, double{plain.pixels[i].g} * seen, 1e-5) << i;
  }
}

TEST_P(FogTest, IgnoresThreadsTilesCropsOrderAndIsa) {
  scene_.image.fog = 0.7f;
  scene_.image.transparent = true;
  scene_.image.spp = 4;
  RenderOptions options = options_of(scene_);
  const Image picture = render(scene_, options);
  expect_picture_of_all_isas(scene_, picture);
  options.threads = 3;
  options.tile = 4;
  options.order = PixelOrder::progressive;
  auto renderer = Renderer::create(scene_, options);
  ASSERT_TRUE(renderer);
  Film film(renderer.value().rect());
  ASSERT_TRUE(renderer.value().render_live(film));
  EXPECT_EQ(film.to_image(Alpha::coverage).alpha, picture.alpha);
  options.crop = PixelRect{11, 7, 40, 33};
  const Image part = render(scene_, options);
  expect_crop_of(picture, part, 11, 7);
}

TEST_P(FogTest, LeavesChannelsUnchanged) {
  RenderOptions options = options_of(scene_);
  options.aovs.depth = options.aovs.albedo = true;
  const auto channels = [&] {
    auto renderer = Renderer::create(scene_, options);
    return renderer.value().render_aovs().value();
  };
  const auto plain = channels();
  options.fog = 0.5f;
  const auto foggy = channels();
  ASSERT_EQ(plain.size(), foggy.size());
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(plain[i].samples, foggy[i].samples);
}

/// A gradient shows behind, so what is far takes its colours.
TEST_P(FogTest, HasTheColoursBehind) {
  scene_.backdrop.reset();
  scene_.background = GradientBackground{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  scene_.image.fog = 1;
  scene_.image.fog_from = 0;
  scene_.image.fog_to = 1;
  const Image all_fog = render(scene_);
  scene_.spheres.clear();
  scene_.capsules.clear();
  EXPECT_EQ(differing_pixels(all_fog, render(scene_)), 0);
}

TEST_P(FogTest, FarSpheresDoNotWidenIt) {
  scene_.capsules.clear();
  scene_.spheres.clear();
  for (int i = 0; i < 400; ++i) {
    const auto x = static_cast<float>(i % 20), z = static_cast<float>(i / 20);
    scene_.spheres.push_back({{0.2F * x - 2, 0, -0.3F * z}, 0.09F, 0});
  }
  scene_.image.fog = 0.8f;
  const Image all = render(scene_);
  scene_.spheres.push_back({{0, 9000, -9000}, 0.09F, 0});
  EXPECT_EQ(differing_pixels(all, render(scene_)), 0);
  scene_.image.fog = 0;
  EXPECT_GT(differing_pixels(all, render(scene_)), 100);
}

TEST_P(FogTest, OfOneSphereStartsAtItsFront) {
  scene_.capsules.clear();
  scene_.spheres = {{{0, 0, 0}, 1, 0}};
  scene_.image.fog = 1;
  const Image foggy = render(scene_);
  scene_.image.fog = 0;
  const Image plain = render(scene_);
  const Color middle = foggy.at(30, 22), without = plain.at(30, 22);
  EXPECT_NEAR(middle.r, without.r, 0.02);
  EXPECT_GT(differing_pixels(plain, foggy), 100);
  scene_.spheres.clear();
  scene_.image.fog = 1;
  const Image nothing = render(scene_);
  EXPECT_TRUE(same_bits(nothing.at(30, 22), mist));
}

INSTANTIATE_TEST_SUITE_P(Methods, FogTest, testing::Values(Method::whitted, Method::path));

TEST(Fog, SpansTheEllipsoidInTheBox) {
  CameraView camera{};
  camera.eye = {0, 0, 10};
  camera.forward = {0, 0, -1};
  camera.kind = CameraKind::pinhole;
  const SphereBounds box{{-3, -1, -2}, {3, 1, 4}};
  Fog fog = fog_of({.fog = 0.5f}, box, camera);
  EXPECT_EQ(fog.from, 6);
  EXPECT_EQ(fog.to, 12);
  EXPECT_EQ(fog.share(6), 0);
  EXPECT_EQ(fog.share(9), 0.25f);
  EXPECT_EQ(fog.share(13), 0.5f);
  camera.eye = {-9, 0, 1};
  camera.forward = {0.6, 0, 0.8};
  fog = fog_of({.fog = 0.5f}, box, camera);
  EXPECT_DOUBLE_EQ(fog.to, 5.4 + 3);
  EXPECT_DOUBLE_EQ(fog.from, 5.4 - 3);
  camera.eye = {0, 0, 1};
  EXPECT_EQ(fog_of({.fog = 0.5f}, box, camera).from, 0) << "from within";
  camera.kind = CameraKind::fisheye;
  camera.eye = {0, 0, -10};
  fog = fog_of({.fog = 0.5f}, box, camera);
  EXPECT_EQ(fog.from, 8);
  EXPECT_EQ(fog.to, 14);
  fog = fog_of({.fog = 0.5f, .fog_from = 1.0f, .fog_to = 2.0f}, box, camera);
  EXPECT_EQ(fog.from, 1);
  EXPECT_EQ(fog.to, 2);
}

TEST(Fog, RefusesWrongNumbers) {
  const auto key_of = [](const auto& change) {
    RenderOptions options;
    change(options);
    const Status done = validate(options);
    return done ? "" : done.error().key;
  };
  for (const float wrong : {-0.1f, 1.1f, std::nanf("")})
    EXPECT_EQ(key_of([&](RenderOptions& o) { o.fog = wrong; }), "image.fog");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.fog_from = -1.0f; }), "image.fog_from");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.fog_to = HUGE_VALF; }), "image.fog_to");
  EXPECT_EQ(key_of([](RenderOptions& o) { o.fog_from = o.fog_to = 2.0f; }), "image.fog_to");
  EXPECT_EQ(key_of([](RenderOptions& o) {
              o.transparent = true;
              o.spp = most_covered_samples + 1;
            }),
            "image.spp");
}

}  // namespace
}  // namespace boule::test
