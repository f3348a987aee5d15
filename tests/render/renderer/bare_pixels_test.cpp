// Pixels through which nothing is seen: certain to miss, and the same picture without their rays.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "render/frame/sampler.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/bare_pixels.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/renderer/measured_pictures.h"
#include "tests/support/capsule_scene.h"
#include "tests/support/case_random.h"

namespace boule::test::bare_pixels {
namespace {

constexpr int width = 48, height = 36;
const Vec3f eye{3, -2, 5};

/// A few balls and capsules around the eye: in front of it, beside it, behind it, through its
/// plane, from a hundredth of a pixel to more than the picture.
Scene scattered_scene(std::uint64_t seed) {
  CaseRandom random(seed);
  Scene scene;
  scene.image = {width, height, 4};
  add_material(scene, Matte{});
  const auto point = [&random] {
    const double distance = random.decade(-1, 2);
    return eye + vec_cast<float>(random.direction() * distance);
  };
  const auto size = [&](const Vec3f& at) {
    const double share = random.decade(-3, -0.1);
    return static_cast<float>(share * length(vec_cast<double>(at - eye)));
  };
  const int spheres = random.below(5), capsules = random.below(3);
  for (int i = 0; i < spheres; ++i) {
    const Vec3f at = point();
    scene.spheres.push_back({at, size(at), MaterialRef(0)});
  }
  for (int i = 0; i < capsules; ++i) {
    const Vec3f a = point(), b = point();
    scene.capsules.push_back({a, b, size(a), 0});
  }
  return scene;
}

Camera scattered_camera(std::uint64_t seed) {
  CaseRandom random(seed, 1);
  const Vec3f to = eye + vec_cast<float>(random.direction());
  const auto fov = static_cast<float>(random.decade(0.5, 2.2));
  if (random.chance(0.3)) return OrthographicCamera{{eye, to, {0.1F, 1, 0.2F}}, fov};
  return PinholeCamera{{eye, to, {0.1F, 1, 0.2F}}, fov, FovAxis::x};
}

/// The raster point at which a camera without a lens shows a point; none behind the eye.
std::optional<RasterPoint> shown(const CameraView& camera, const Vec3d& point) {
  const Vec3d way = point - camera.eye;
  const bool is_parallel = camera.kind == CameraKind::orthographic;
  const double depth = is_parallel ? 1 : dot(way, camera.forward);
  if (!(depth > 0)) return std::nullopt;
  const auto raster = [&](const RasterToFilm& map, const Vec3d& half) {
    return (dot(way, half) / dot(half, half) / depth * map.extent - map.offset) / map.scale;
  };
  return RasterPoint{raster(camera.film_x, camera.right), raster(camera.film_y, camera.up)};
}

/// Points on balls and capsules, as they are.
std::vector<Vec3d> points_of(const Scene& scene, CaseRandom& random) {
  std::vector<Vec3d> points;
  const auto add = [&](const Vec3f& center, float radius) {
    points.push_back(vec_cast<double>(center) + random.direction() * double{radius});
  };
  for (int i = 0; i < 200; ++i) {
    for (const Sphere& sphere : scene.spheres) add(sphere.center, sphere.radius);
    for (const Capsule& capsule : scene.capsules) {
      const auto share = static_cast<float>(random.uniform());
      add(capsule.a + (capsule.b - capsule.a) * share, capsule.radius);
    }
  }
  return points;
}

TEST(BarePixels, NothingIsSeenThroughThem) {
  int known = 0, empty = 0, shown_points = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    Scene scene = scattered_scene(seed);
    scene.camera = scattered_camera(seed);
    const PreparedScene prepared = prepare(scene, width, height).value();
    const PixelRect rect = seed % 3 == 0 ? PixelRect{7, 5, 40, 29} : PixelRect{0, 0, width, height};
    const BarePixels bare(prepared, rect, serial_for);
    CaseRandom random(seed, 2);
    for (const Vec3d& point : points_of(scene, random)) {
      const auto at = shown(prepared.camera_view, point);
      if (!at) continue;
      ++shown_points;
      // A sample lies up to a pixel from the middle of its own pixel.
      for (const double side : {-0.5, 0.5}) {
        const double x = std::floor(at->x + side), y = std::floor(at->y + side);
        const bool is_in = x >= 0 && x < width && y >= 0 && y < height;
        EXPECT_FALSE(is_in && bare.is_bare(static_cast<int>(x), static_cast<int>(y)))
            << seed << ": " << x << ' ' << y;
      }
    }
    for (int y = rect.y0; y < rect.y1; y += 3) {
      for (int x = rect.x0; x < rect.x1; x += 3) {
        const Ray ray = primary_ray(prepared.camera_view, x + 0.5, y + 0.5);
        empty += reference::any_hit(ray, scene.spheres, {}, scene.capsules) ? 0 : 1;
        known += bare.is_bare(x, y) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(shown_points, 100000);
  EXPECT_GT(known, 0.5 * empty);
}

/// The directions of such a narrow view's rays are rounded by more than a pixel.
TEST(BarePixels, RoundedDirectionsCount) {
  Scene scene;
  add_material(scene, Matte{});
  int met = 0;
  for (int i = 0; i < 30; ++i) {
    const Vec3f middle =
        Vec3f{599999, 480002, 640001} + Vec3f{0.1F, 0.07F, 0.05F} * static_cast<float>(i);
    scene.spheres = {{middle, 0.02F, MaterialRef(0)}};
    scene.camera = pinhole({0, 0, 0}, middle, 5e-6F);
    const PreparedScene prepared = prepare(scene, width, height).value();
    const BarePixels bare(prepared, {0, 0, width, height}, serial_for);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Ray ray = primary_ray(prepared.camera_view, x + 0.5, y + 0.5);
        if (!reference::any_hit(ray, scene.spheres, {})) continue;
        EXPECT_FALSE(bare.is_bare(x, y)) << x << ' ' << y;
        ++met;
      }
    }
  }
  EXPECT_GT(met, 100);
}

/// A plane behind the camera and away from all lights, as black as the sky that it hides, changes
/// nothing in the picture; with it every sample has its ray.
TEST(BarePixels, PictureIsThatOfAllRays) {
  struct Case {
    Method method;
    float aa, noise, outline;
    bool transparent;
  };
  for (const auto& [method, aa, noise, outline, transparent] :
       {Case{Method::whitted, 0, 0, 0, false}, Case{Method::whitted, 8, 0, 1, true},
        Case{Method::whitted, 8, 0, 0, false}, Case{Method::path, 0, 0, 2, true},
        Case{Method::path, 0, 0.1F, 0, false}}) {
    Scene scene = capsule_scene(width, height);
    scene.planes.clear();
    scene.spheres.push_back({{4, 3, 0}, 0.7F, add_material(scene, Ghost{})});
    scene.camera = pinhole({0, 0, 20}, {0, 0, 0}, 45);
    RenderOptions options = options_of(scene);
    options.method = method;
    options.spp = 32;
    options.min_spp = 16;
    options.aa = aa;
    options.noise = noise;
    options.outline = outline;
    options.transparent = transparent;
    options.filter = PixelFilter::tent;
    scene.background = ConstantBackground{{0, 0, 0}};
    Renderer renderer = Renderer::create(scene, options).value();
    const Image picture = renderer.render().value();
    const bool is_measured = aa > 0 || noise > 0;
    const std::uint64_t samples = is_measured ? hash_of(measured(scene, options)) : 0;
    RenderOptions cropped = options;
    cropped.crop = PixelRect{5, 9, 43, 31};
    const PixelRect part{6, 10, 42, 30};
    if (is_measured)
      EXPECT_EQ(hash_of(measured(scene, cropped), part), hash_of(measured(scene, options), part));
    scene.planes = {{{0, -80, 80}, {0, 0.8F, -0.6F}, add_material(scene, Matte{{0, 0, 0}})}};
    Renderer every_ray = Renderer::create(scene, options).value();
    const Image expected = every_ray.render().value();
    EXPECT_EQ(differing_pixels(picture, expected), 0);
    EXPECT_EQ(picture.alpha, expected.alpha);
    EXPECT_EQ(samples, is_measured ? hash_of(measured(scene, options)) : 0);
    EXPECT_LT(static_cast<double>(renderer.statistics().rays.primary),
              0.8 * static_cast<double>(every_ray.statistics().rays.primary));
  }
}

/// Where they are not known, no pixel is bare.
TEST(BarePixels, OtherCamerasHaveNone) {
  Scene scene = scattered_scene(1);
  scene.spheres.clear();
  scene.capsules.clear();
  for (const Camera& camera :
       {Camera(FisheyeCamera{{eye, {0, 0, -1}, {0, 1, 0}}, 120, FovAxis::x}),
        Camera(ThinLensCamera{{eye, {0, 0, 0}, {0, 1, 0}}, 45, FovAxis::x, 0.1F}),
        Camera(PinholeCamera{{eye, {0, 0, 0}, {0, 1, 0}}, 45, FovAxis::x})}) {
    scene.camera = camera;
    const PreparedScene prepared = prepare(scene, width, height).value();
    const BarePixels bare(prepared, {0, 0, width, height}, serial_for);
    EXPECT_EQ(bare.is_bare(5, 5), std::holds_alternative<PinholeCamera>(camera));
    EXPECT_FALSE(bare.is_bare(-1, 5));
    EXPECT_FALSE(bare.is_bare(5, height));
  }
}

}  // namespace
}  // namespace boule::test::bare_pixels
