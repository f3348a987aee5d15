#include "render/integrators/whitted.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "render/prepare/prepared_scene.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// The renderer's radiance is float and the oracle's is double; the hits are the same. Rounding
/// errors add up over eight bounces and over lights of very different strength.
constexpr double float_noise = 2e-5;

TEST(Whitted, EqualsTheOracleOnMixedFeatures) {
  const Scene scene = mixed_scene(64, 48);
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

TEST(Whitted, EqualsTheOracleAtEveryDepth) {
  Scene scene = mixed_scene(24, 20);
  for (const int depth : {0, 1, 2, 3, 7}) {
    scene.render.max_depth = depth;
    EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise) << depth;
  }
}

TEST(Whitted, EqualsTheOracleOrthographically) {
  Scene scene = mixed_scene(40, 40);
  scene.camera = OrthographicCamera{{{2, 4, 6}, {0, 0.5f, 0}, {0, 1, 0}}, 6};
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

TEST(Whitted, EqualsTheOracleFarFromTheOrigin) {
  const Scene scene = moved(mixed_scene(64, 48), {1e5f, -1e5f, 1e5f});
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

TEST(Whitted, EqualsTheOracleInGlassClouds) {
  const Scene scene = glass_cloud(32, 32);
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

TEST(Whitted, EqualsTheOracleOnHugeGrounds) {
  Scene scene = mixed_scene(48, 36);
  scene.planes.clear();
  scene.spheres.push_back({{0, -1e6f, 0}, 1e6f, 6});
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

TEST(Whitted, EqualsTheOracleInsideASphere) {
  Scene scene = mixed_scene(32, 32);
  scene.spheres.push_back({{0, 1, 0}, 30, 1});
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
  scene.spheres.back() = {{0.5f, 1.6f, 6}, 1, 3};  // a glass ball with the eye at its centre
  EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
}

/// An environment of an odd number of pixels of all colours, rotated by more than a turn; and
/// images of one pixel, of one row and of one column.
TEST(Whitted, EqualsTheOracleInAnEnvironment) {
  Scene scene = mixed_scene(64, 48);
  scene.planes.clear();
  CaseRandom random(11);
  for (const auto& [width, height] : {std::pair{7, 5}, {1, 1}, {6, 1}, {1, 6}}) {
    EnvironmentBackground image{width, height, {}, 400 * static_cast<float>(random.uniform(-1, 1))};
    for (int i = 0; i < width * height; ++i) {
      const auto tone = [&] { return static_cast<float>(random.uniform(0.2, 1)); };
      const float r = tone(), g = tone(), b = tone();
      image.pixels.push_back({r, g, b});
    }
    scene.background = image;
    EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise) << width << " x " << height;
  }
}

TEST(Whitted, GlassPlanesRefractByEntrySide) {
  for (const float y : {1.0f, -1.0f}) {
    Scene scene = empty_scene(24, 24);
    scene.camera = pinhole({0, y, 3}, {0, 0, 0}, 60);
    scene.background = GradientBackground{{0, 0, 1}, {1, 0, 0}, {0.3f, 1, 0.2f}};
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add_material(scene, Glass{})}};
    EXPECT_LT(distance_to_oracle(scene, render(scene)), float_noise);
  }
}

/// The colour of the only pixel of a picture of 1 x 1.
Color pixel_of(Scene scene) {
  scene.image = {1, 1, 1};
  const Image image = render(scene);
  return image.pixels.empty() ? gray(-1) : image.at(0, 0);
}

/// A unit sphere of one material, straight before the camera.
Scene one_sphere(const Material& material) {
  Scene scene = empty_scene(1, 1);
  scene.spheres = {{{0, 0, 0}, 1, add_material(scene, material)}};
  return scene;
}

TEST(Whitted, GivesKnownColours) {
  Scene scene = one_sphere(Matte{{0.5f, 0.25f, 1}});
  scene.lights = {DirectionalLight{{0, 0, -1}, {1, 1, 0.5f}}};
  EXPECT_EQ(pixel_of(scene), (Color{0.5f, 0.25f, 0.5f}));  // n.l = 1
  scene.ambient = {0.5f, 0, 0};
  EXPECT_EQ(pixel_of(scene), (Color{0.75f, 0.25f, 0.5f}));
  scene.materials[0].material = Emissive{{7, 8, 9}};
  EXPECT_EQ(pixel_of(scene), (Color{7, 8, 9}));
  scene.background = ConstantBackground{{4, 2, 1}};
  scene.materials[0].material = Metal{{0.5f, 0.5f, 1}};
  EXPECT_EQ(pixel_of(scene), (Color{2, 1, 1}));
  // In uniform light glass loses only the light that is left after the last bounce.
  scene.materials[0].material = Glass{};
  scene.background = ConstantBackground{gray(1)};
  scene.render.max_depth = 40;
  EXPECT_NEAR(pixel_of(scene).g, 1, 1e-6);
}

TEST(Whitted, DepthZeroIsDirectLightOnly) {
  Scene scene = one_sphere(Phong{gray(1), 0, 1, 0.5f, 0, 0.5f, 1.5f});
  scene.render.max_depth = 0;
  scene.background = ConstantBackground{gray(100)};
  scene.lights = {DirectionalLight{{0, 0, -1}, gray(1)}};
  EXPECT_EQ(pixel_of(scene), gray(1));
  scene.spheres.push_back({{0, 0, 20}, 3, 0});  // between the light and the scene, behind the eye
  EXPECT_EQ(pixel_of(scene), gray(0));
}

TEST(Whitted, TransparentObjectsCastShadows) {
  for (const Material& blocker :
       {Material{Glass{}}, Material{Emissive{gray(0)}}, Material{Matte{}}}) {
    Scene scene = one_sphere(Matte{gray(1)});
    scene.lights = {PointLight{{0, 8, 8}, gray(1), Falloff::none}};
    const Color lit = pixel_of(scene);
    EXPECT_GT(lit.r, 0);
    scene.spheres.push_back({{0, 4, 4.5f}, 0.5f, add_material(scene, blocker)});
    EXPECT_EQ(pixel_of(scene), gray(0));
    scene.spheres.back().center = {0, 16, 16};  // behind the light, where it casts no shadow
    EXPECT_EQ(pixel_of(scene), lit);
  }
}

TEST(Whitted, SurfacesNeverShadowLightsOnThem) {
  // The light's position is rounded to float: just inside or outside of the small sphere on which
  // it is.
  int lit = 0;
  CaseRandom random(5);
  for (int i = 0; i < 50; ++i) {
    Scene scene = empty_scene(1, 1);
    scene.camera = pinhole({0, 5, 0.1f}, {0, 0, 0}, 10);
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add_material(scene, Matte{gray(1)})}};
    Vec3d down = random.direction();
    down.y = -std::fabs(down.y) - 0.2;
    const Vec3d center{3, 4, 0};
    scene.spheres = {{vec_cast<float>(center), 1, 0}};
    scene.lights = {PointLight{vec_cast<float>(center + normalize(Vec3d{-3, -4, 0} + down * 0.2)),
                               gray(1), Falloff::none}};
    lit += pixel_of(scene).r > 0 ? 1 : 0;
  }
  EXPECT_EQ(lit, 50);
}

TEST(Whitted, LightsInsideObjectsAreHarmless) {
  for (const Falloff falloff : {Falloff::none, Falloff::inverse_square}) {
    Scene scene = one_sphere(Plastic{});
    for (const Vec3f& p : {Vec3f{0, 0, 1}, Vec3f{0, 0, 0}, Vec3f{0, 0, 1.0000001f}}) {
      scene.lights = {PointLight{p, gray(1), falloff}};
      const Color c = pixel_of(scene);
      EXPECT_TRUE(std::isfinite(c.r) && c.r >= 0);
    }
  }
}

TEST(Whitted, OverflowGivesTheLargestFloat) {
  constexpr float largest = std::numeric_limits<float>::max();
  Scene scene = mixed_scene(24, 18);
  scene.ambient = gray(3e38f);
  scene.background = ConstantBackground{gray(3e38f)};
  scene.lights = {PointLight{{3, 5, 4}, {3e38f, 0, 1}, Falloff::inverse_square},
                  PointLight{{0, 1, 1.5f}, {3e38f, 0, 1e-45f}, Falloff::inverse_square}};
  const auto wild =
      add_material(scene, Phong{{0, 3e38f, 1}, 3e38f, 3e38f, 3e38f, 3e38f, 3e38f, 1e-38f});
  for (Sphere& s : scene.spheres) s.material = wild;
  for (const Color& c : render(scene).pixels) {
    for (const float x : {c.r, c.g, c.b}) EXPECT_TRUE(x >= 0 && x <= largest);
  }
  scene.spheres.push_back({{0.5f, 1.6f, 5}, 1e-45f, 3});  // of denormal radius, straight ahead
  for (const Color& c : render(scene).pixels) {
    for (const float x : {c.r, c.g, c.b}) EXPECT_TRUE(x >= 0 && x <= largest);
  }
}

/// Camera rays of every pixel of a scene, in rows.
std::vector<Ray> camera_rays(const Scene& scene) {
  const CameraView view = build_camera(*scene.camera, scene.image.width, scene.image.height);
  std::vector<Ray> rays;
  for (int y = 0; y < scene.image.height; ++y) {
    for (int x = 0; x < scene.image.width; ++x) {
      rays.push_back(primary_ray(view, x + 0.5, y + 0.5));
    }
  }
  return rays;
}

/// The radiance of these rays by a new integrator.
std::vector<Color> trace(const PreparedScene& scene, const std::vector<Ray>& rays,
                         const IntegratorSettings& settings) {
  Whitted whitted(scene, *select_kernels("auto").value(), settings);
  RayBuffer stream = to_stream(rays);
  std::vector<Color> radiance(rays.size());
  EXPECT_TRUE(whitted.trace({stream, scene.coherence, nullptr}, radiance.data()));
  return radiance;
}

int differing(const std::vector<Color>& a, const std::vector<Color>& b) {
  int count = a.size() == b.size() ? 0 : -1000000;
  for (std::size_t i = 0; i < a.size(); ++i) count += same_bits(a[i], b[i]) ? 0 : 1;
  return count;
}

TEST(Whitted, StreamSizeDoesNotMatter) {
  for (const Scene& scene : {mixed_scene(32, 24), glass_cloud(24, 24)}) {
    const PreparedScene prepared = prepare(scene, scene.image.width, scene.image.height).value();
    const std::vector<Ray> rays = camera_rays(scene);
    IntegratorSettings settings;
    settings.max_depth = 8;
    const std::vector<Color> expected = trace(prepared, rays, settings);
    for (const std::size_t size : {1, 2, 16, 100, 300, 700, 100000}) {
      settings.stream_size = size;
      EXPECT_EQ(differing(trace(prepared, rays, settings), expected), 0) << size;
    }
  }
}

TEST(Whitted, RadianceDoesNotDependOnTheStream) {
  const Scene scene = glass_cloud(16, 16);
  const PreparedScene prepared = prepare(scene, 16, 16).value();
  const std::vector<Ray> rays = camera_rays(scene);
  const IntegratorSettings settings;
  const std::vector<Color> expected = trace(prepared, rays, settings);
  std::vector<Color> alone, backwards = trace(prepared, {rays.rbegin(), rays.rend()}, settings);
  std::reverse(backwards.begin(), backwards.end());
  for (const Ray& ray : rays) alone.push_back(trace(prepared, {ray}, settings)[0]);
  EXPECT_EQ(differing(alone, expected), 0);
  EXPECT_EQ(differing(backwards, expected), 0);
}

TEST(Whitted, CountsItsRays) {
  Scene scene = one_sphere(Phong{gray(1), 0, 1, 0.5f, 1, 0.5f, 1.5f});
  scene.lights = {DirectionalLight{{0, 0, -1}, gray(1)}, DirectionalLight{{0, 0, 1}, gray(1)}};
  const PreparedScene prepared = prepare(scene, 1, 1).value();
  IntegratorSettings settings;
  settings.max_depth = 1;
  Whitted whitted(prepared, *select_kernels("auto").value(), settings);
  RayBuffer ray = to_stream(camera_rays(scene));
  Color radiance;
  ASSERT_TRUE(whitted.trace({ray, Coherence::common_origin, nullptr}, &radiance));
  const RayCounts counts = whitted.counts();
  EXPECT_EQ(counts.primary, 1u);
  EXPECT_EQ(counts.continuation, 2u);  // one reflected, one refracted
  // The light before the sphere faces both hits, also the far wall inside; the other faces neither.
  EXPECT_EQ(counts.shadow, 2u);
  EXPECT_EQ(counts.total(), 5u);
}

TEST(Whitted, ZeroRaysAreNoWork) {
  const Scene scene = mixed_scene(4, 4);
  const PreparedScene prepared = prepare(scene, 4, 4).value();
  Whitted whitted(prepared, *select_kernels("auto").value(), {});
  RayBuffer none;
  EXPECT_TRUE(whitted.trace({none, Coherence::none, nullptr}, nullptr));
  EXPECT_EQ(whitted.counts().total(), 0u);
}

TEST(Whitted, StopsWhenCancelledAndWorksAgainAfterwards) {
  const Scene scene = mixed_scene(8, 8);
  const PreparedScene prepared = prepare(scene, 8, 8).value();
  const std::vector<Ray> rays = camera_rays(scene);
  std::atomic<bool> cancel{true};
  IntegratorSettings settings;
  const std::vector<Color> expected = trace(prepared, rays, settings);
  settings.cancel = &cancel;
  Whitted whitted(prepared, *select_kernels("auto").value(), settings);
  RayBuffer stream = to_stream(rays);
  std::vector<Color> radiance(rays.size(), gray(-1));
  EXPECT_FALSE(whitted.trace({stream, Coherence::none, nullptr}, radiance.data()));
  EXPECT_EQ(radiance[0], gray(-1));
  cancel = false;
  EXPECT_TRUE(whitted.trace({stream, Coherence::none, nullptr}, radiance.data()));
  EXPECT_EQ(differing(radiance, expected), 0);
}

/// Two parallel mirrors, between which a ray goes on for ever. Memory must not grow with the depth.
TEST(Whitted, AnEndlessHallOfMirrorsEnds) {
  Scene scene = empty_scene(2, 2);
  scene.background = ConstantBackground{gray(1)};
  scene.render.max_depth = 100000;
  const auto mirror = add_material(scene, Metal{gray(1)});
  scene.planes = {{{0, 0, -1}, {0, 0, 1}, mirror}, {{0, 0, 6}, {0, 0, -1}, mirror}};
  scene.camera = pinhole({0, 0, 5}, {0, 0, 0}, 1e-3f);
  EXPECT_EQ(render(scene).pixels.size(), 4u);
}

}  // namespace
}  // namespace boule::test
