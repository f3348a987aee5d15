#include "render/integrators/path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/geometry.h"
#include "core/math/warp.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "render/prepare/prepared_scene.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/path_scenes.h"

namespace boule::test {
namespace {

/// A white sphere, or several of them, in white light from all directions: everything is white.
Scene furnace(const Material& material) {
  Scene scene = empty_scene(32, 32);
  scene.background = ConstantBackground{gray(1)};
  scene.render.method = Method::path;
  scene.render.max_depth = max_count;
  scene.spheres = {{{0, 0, 0}, 1.5f, add_material(scene, material)}};
  return scene;
}

TEST(PathFurnace, OneSphereEqualsItsSurroundings) {
  for (const Material& material :
       {Material{Matte{gray(1)}}, Material{Metal{gray(1)}}, Material{Plastic{gray(1), 0, 0, 0}},
        Material{Plastic{gray(0.6f), 0, 0, 0.4f}}, Material{Phong{gray(1), 0.5f, 1}}}) {
    Scene scene = furnace(material);
    scene.image.spp = 4;
    for (const Color& c : render(scene).pixels) {
      for (const float x : {c.r, c.g, c.b}) EXPECT_NEAR(x, 1, 1e-5) << material.index();
    }
  }
}

/// The mean of a furnace's pixels and its standard error; the pixels are independent.
void expect_white(Scene scene, int spp, double most) {
  scene.image.spp = spp;
  Moments moments;
  for (const Color& c : render(scene).pixels) moments.add(luminance(c));
  EXPECT_NEAR(moments.mean, 1, 3 * std::sqrt(moments.variance_of_mean()) + 1e-6);
  EXPECT_NEAR(moments.mean, 1, most);
}

TEST(PathFurnace, GlassIsWhiteInTheMean) { expect_white(furnace(Glass{}), 64, 0.002); }

TEST(PathFurnace, TouchingSpheresAreWhiteInTheMean) {
  Scene scene = furnace(Matte{gray(1)});
  scene.image = {64, 64, 1};
  const MaterialRef material = scene.spheres[0].material;
  scene.spheres.clear();
  for (int i = 0; i < 32; ++i) {
    const auto x = static_cast<float>(i % 4), y = static_cast<float>(i / 4 % 4),
               z = static_cast<float>(i / 16);
    scene.spheres.push_back({{x - 1.5f, y - 1.5f, -z}, 0.5f, material});
  }
  expect_white(scene, 64, 0.002);
}

/// No material sends on more light than it gets, whatever its coefficients are.
TEST(PathFurnace, NothingIsBrighterThanItsSurroundings) {
  for (const Material& material :
       {Material{Plastic{gray(0.9f), 0.5f, 30, 0.3f}}, Material{Plastic{gray(0.5f), 0.5f, 2, 0}},
        Material{Phong{gray(1), 1, 1, 0.5f, 20, 0.5f, 1.4f}}, Material{Matte{gray(3)}},
        Material{Metal{gray(2)}}, Material{Glass{gray(2), 1.3f}}}) {
    Scene scene = furnace(material);
    scene.image.spp = 64;
    Moments moments;
    for (const Color& c : render(scene).pixels) moments.add(luminance(c));
    EXPECT_LT(moments.mean, 1 + 3 * std::sqrt(moments.variance_of_mean()) + 1e-6)
        << material.index();
    EXPECT_GT(moments.mean, 0.5) << material.index();
  }
}

/// A white plane seen from above at (x, 0, 0), so close that all of the picture shows about one
/// point.
Scene lit_plane(float x, float tilt) {
  Scene scene = empty_scene(4, 4);
  scene.camera = OrthographicCamera{{{x, 0.1f, 0}, {x, 0, 0}, {0, 0, 1}}, 1e-4f};
  scene.render.method = Method::path;
  scene.render.max_depth = 0;
  scene.planes = {{{x, 0, 0}, {tilt, 1, 0}, add_material(scene, Matte{gray(1)})}};
  scene.image.spp = 256;
  return scene;
}

constexpr double light_height = 3, light_radius = 1.25;

/// The irradiance over pi that the sphere light above gives the plane's point, by the midpoint rule
/// over the part of the cone with cos > 0.
double plane_radiance(double x, double tilt) {
  const Vec3d to_light = Vec3d{-x, light_height, 0};
  const double distance = length(to_light);
  const Vec3d axis = normalize(to_light), normal = normalize(Vec3d{tilt, 1, 0});
  const Vec3d side = {-axis.y, axis.x, 0}, other = cross(axis, side);
  const double cone = std::asin(light_radius / distance);
  constexpr int rings = 1000, parts = 1000;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double a = cone * (i + 0.5) / rings;
    for (int k = 0; k < parts; ++k) {
      const double b = 2 * elementary::pi * (k + 0.5) / parts;
      const Vec3d w = axis * std::cos(a) + side * (std::sin(a) * std::cos(b)) +
                      other * (std::sin(a) * std::sin(b));
      sum += std::max(0.0, dot(w, normal)) * std::sin(a);
    }
  }
  return sum * (cone / rings) * (2 * elementary::pi / parts) / elementary::pi;
}

double mean_luminance(const Scene& scene) {
  Moments moments;
  for (const Color& c : render(scene).pixels) moments.add(luminance(c));
  return moments.mean;
}

TEST(PathLight, SphereLightIrradianceIsAnalytic) {
  for (const float x : {0.0f, 1.0f, 4.0f}) {
    Scene scene = lit_plane(x, 0);
    const double d2 = light_height * light_height + double{x} * double{x};
    const double analytic = light_radius * light_radius / d2 * (light_height / std::sqrt(d2));
    EXPECT_NEAR(plane_radiance(double{x}, 0) / analytic, 1, 1e-4);
    scene.lights = {SphereLight{{0, light_height, 0}, light_radius, gray(1)}};
    EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 0.005) << x;
    scene.render.method = Method::whitted;  // here it is a point light of the same brightness
    EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 1e-4) << x;
    scene.render.method = Method::path;  // the same with an emissive sphere
    scene.lights.clear();
    scene.spheres = {{{0, light_height, 0}, light_radius, add_material(scene, Emissive{gray(1)})}};
    EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 0.005) << x;
    scene.render.max_depth = 1;
    EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 0.005) << x;
  }
}

TEST(PathLight, LightsBelowTheHorizonCountInPart) {
  for (const float tilt : {1.0f, 2.5f, -3.0f}) {
    Scene scene = lit_plane(2, tilt);
    scene.lights = {SphereLight{{0, light_height, 0}, light_radius, gray(1)}};
    const double expected = plane_radiance(2, double{tilt});
    EXPECT_NEAR(mean_luminance(scene), expected, 0.005 * expected) << tilt;
  }
}

/// The irradiance over pi that a capsule of radiance 1 gives the plane's point (0, 0, 0): the share
/// of rays that meet it, by a grid of directions as dense as their cosine.
double shown_share(const Capsule& capsule) {
  constexpr int side = 1000;
  int met = 0;
  for (int i = 0; i < side; ++i) {
    const double u = (i + 0.5) / side, across = std::sqrt(u), up = std::sqrt(1 - u);
    for (int k = 0; k < side; ++k) {
      const double turn = 2 * elementary::pi * (k + 0.5) / side;
      const Vec3d direction = {across * std::cos(turn), up, across * std::sin(turn)};
      const Ray ray = {{0, 0, 0}, vec_cast<float>(direction)};
      met += std::isfinite(reference::intersect(ray, capsule, false)) ? 1 : 0;
    }
  }
  return static_cast<double>(met) / (side * side);
}

/// Capsules are found by paths alone, beside lamps that are sampled as well: no light is counted
/// twice or lost.
TEST(PathLight, EmissiveCapsulesGiveTheirLight) {
  Scene scene = lit_plane(0, 0);
  scene.image.spp = 4096;
  scene.render.max_depth = 1;
  const MaterialRef lamp = add_material(scene, Emissive{gray(1)});
  scene.capsules = {{{-1, 1, 0.5f}, {1.5f, 2, 0.5f}, 0.5f, lamp}};
  const double alone = shown_share(scene.capsules[0]);
  EXPECT_NEAR(mean_luminance(scene) / alone, 1, 0.01);
  scene.spheres = {{{0, 3, -4}, 1, lamp}};
  const double of_sphere = 1.0 / 25 * (3.0 / 5);
  EXPECT_NEAR(mean_luminance(scene) / (alone + of_sphere), 1, 0.01);
  scene.lights = {SphereLight{{0, 3, -4}, 1, gray(1)}};  // in place of the sphere
  scene.spheres.clear();
  EXPECT_NEAR(mean_luminance(scene) / (alone + of_sphere), 1, 0.01);
}

/// Both methods agree on what both compute: the direct light of point lights on matte objects.
TEST(PathLight, PointLightsEqualWhittedAtDepthZero) {
  Scene scene = mixed_scene(32, 24);
  scene.ambient = {};
  for (NamedMaterial& named : scene.materials) {
    if (!std::holds_alternative<Emissive>(named.material))
      named.material = Matte{{0.5f, 0.6f, 0.7f}};
  }
  scene.spheres.erase(scene.spheres.begin() + 6);  // the lamp, which is a light for path tracing
  scene.render.max_depth = 0;
  const Image whitted = render(scene);
  scene.render.method = Method::path;
  EXPECT_EQ(differing_pixels(render(scene), whitted), 0);
}

/// A grey image with a bright spot straight up, and no other light.
EnvironmentBackground spotted_image(float rotation) {
  EnvironmentBackground image{16, 8, std::vector<Color>(128, gray(0.5f)), rotation};
  image.pixels[16 + 4] = {20, 10, 5};
  return image;
}

TEST(PathLight, UniformEnvironmentEqualsConstantBackground) {
  Scene scene = furnace(Matte{gray(1)});
  scene.background = EnvironmentBackground{3, 2, std::vector<Color>(6, gray(1)), 20};
  expect_white(scene, 16, 0.01);
}

TEST(PathLight, EnvironmentSamplesFollowTheImage) {
  const EnvironmentBackground image = spotted_image(77);
  const EnvironmentLight light(image);
  Vec3d by_chance, integral;
  double whole = 0;
  constexpr int n = 65536;
  for (std::uint32_t i = 0; i < n; ++i) {
    const UnitPair numbers = sobol_pair(1, RandomSet::film, i);
    const auto [direction, density] = light.sample(numbers);
    ASSERT_GT(density, 0);
    const double red = static_cast<double>(environment_radiance(image, direction).r);
    by_chance = by_chance + direction * (red / density / n);
    const Vec3d even = direction_about({0, 0, 1}, warp_to_cone(numbers.u, 2.0), numbers.v);
    const double red_there = static_cast<double>(environment_radiance(image, even).r);
    integral = integral + even * (red_there * 4 * elementary::pi / n);
    whole += light.density(even) * 4 * elementary::pi / n;
  }
  EXPECT_NEAR(whole, 1, 0.005);
  EXPECT_LT(length(by_chance - integral), 0.01 * length(integral));
}

/// A pixel's light spreads to its neighbours, even if these are black, and samples go to all of it.
/// The irradiance is compared with a fine grid over all directions.
TEST(PathLight, EnvironmentSamplesCoverIsolatedBrightPixels) {
  for (const int at : {4, 3 * 16 + 15, 7 * 16}) {
    EnvironmentBackground image{16, 8, std::vector<Color>(128), 0};
    image.pixels[static_cast<std::size_t>(at)] = gray(100);
    const EnvironmentLight light(image);
    double by_chance = 0, integral = 0, most = 0;
    constexpr int n = 65536, rows = 1024;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto [direction, density] = light.sample(sobol_pair(1, RandomSet::film, i));
      const double share = luminance(environment_radiance(image, direction)) / density;
      by_chance += share / n;
      most = std::max(most, share);
    }
    for (int y = 0; y < rows; ++y) {
      const double polar = elementary::pi * (y + 0.5) / rows;
      for (int x = 0; x < 2 * rows; ++x) {
        const double around = elementary::pi * (x + 0.5) / rows;
        const Vec3d d{std::sin(polar) * std::sin(around), std::cos(polar),
                      -std::sin(polar) * std::cos(around)};
        integral += luminance(environment_radiance(image, d)) * std::sin(polar);
      }
    }
    integral *= (elementary::pi / rows) * (elementary::pi / rows);
    EXPECT_NEAR(by_chance / integral, 1, 0.005) << at;
    EXPECT_LT(most, 20 * integral) << at;  // no single sample decides the picture
  }
}

/// A lamp beside a far stronger one that is far away and below the horizon.
TEST(PathLight, EveryLampIsPicked) {
  Scene scene = lit_plane(0, 0);
  scene.lights = {SphereLight{{0, light_height, 0}, light_radius, gray(1)},
                  SphereLight{{0, -1.5e11f, 0}, 7e8f, gray(1e4f)}};
  const double analytic = light_radius * light_radius / (light_height * light_height);
  EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 0.02);
}

/// From far away a point is known with a larger error; the shadow rays to a lamp still end before
/// it.
TEST(PathLight, LampsLightViewsFromAnyDistance) {
  Scene scene = lit_plane(2, 0);
  scene.spheres = {{{0, -light_height, 0}, 0.5f, add_material(scene, Emissive{gray(1)})}};
  const double d2 = light_height * light_height + 4;
  const double analytic = 0.25 / d2 * (light_height / std::sqrt(d2));
  for (const float far : {1e3f, 1e8f, 1e9f}) {
    scene.camera = OrthographicCamera{{{2, -far, 0}, {2, 0, 0}, {0, 0, 1}}, 1e-4f};
    EXPECT_NEAR(mean_luminance(scene) / analytic, 1, 0.01) << far;
  }
}

TEST(PathFurnace, TheSharpestHighlightIsAMirror) {
  Scene scene = furnace(Plastic{gray(0), 1, 1e20f, 0});
  scene.image.spp = 64;
  const double sharp = mean_luminance(scene);
  std::get<Plastic>(scene.materials[0].material).shininess = 1e10f;
  EXPECT_NEAR(sharp, mean_luminance(scene), 0.01);
}

TEST(PathLight, SphereLightsAreInvisibleToRays) {
  Scene scene = empty_scene(16, 16);
  scene.background = ConstantBackground{gray(0.25f)};
  scene.lights = {SphereLight{{0, 0, 0}, 1, gray(100)}};
  for (const Method method : {Method::whitted, Method::path}) {
    scene.render.method = method;
    for (const Color& c : render(scene).pixels) EXPECT_EQ(c, gray(0.25f));
  }
}

void expect_same_however_rendered(Scene scene) {
  scene.image.spp = 3;
  RenderOptions usual = options_of(scene);
  usual.seed = 5;
  const Image expected = render(scene, usual);
  std::vector<RenderOptions> others;
  for (const IsaInfo& isa : list_isas()) {
    if (!isa.supported) continue;
    others.push_back(usual);
    others.back().isa = std::string(isa.name);
  }
  for (const PixelOrder order :
       {PixelOrder::rows, PixelOrder::progressive, PixelOrder::frameless}) {
    for (const int tile : {1, 7, 64}) {
      others.push_back(usual);
      others.back().order = order;
      others.back().tile = tile;
      others.back().threads = static_cast<unsigned>(tile % 5 + 1);
    }
  }
  others.push_back(usual);
  others.back().solver = Solver::reference;
  for (const RenderOptions& options : others) {
    EXPECT_EQ(differing_pixels(render(scene, options), expected), 0)
        << options.isa << " " << options.tile << " " << options.threads;
  }
  RenderOptions cropped = usual;
  cropped.crop = PixelRect{11, 7, 30, 22};
  const Image part = render(scene, cropped);
  expect_crop_of(expected, part, 11, 7);
  usual.seed = 6;
  EXPECT_GT(differing_pixels(render(scene, usual), expected), 40 * 30 / 2);
}

TEST(Path, PictureDependsOnSceneAndSeedOnly) { expect_same_however_rendered(path_scene(40, 30)); }

TEST(Path, EnvironmentPictureDependsOnSceneAndSeed) {
  Scene scene = path_scene(40, 30);
  scene.planes.pop_back();
  scene.background = spotted_image(200);
  expect_same_however_rendered(scene);
}

TEST(Path, StreamSizeDoesNotMatter) {
  const Scene scene = path_scene(24, 18);
  const PreparedScene prepared = prepare(scene, 24, 18, serial_for, Method::path).value();
  const CameraView view = build_camera(*scene.camera, 24, 18);
  RayBuffer rays(24 * 18);
  std::vector<SampleId> ids;
  for (int i = 0; i < 24 * 18; ++i) {
    ids.push_back({i % 24, i / 24, 3});
    rays.set(static_cast<std::size_t>(i), primary_ray(view, i % 24 + 0.5, i / 24 + 0.5));
  }
  const auto traced = [&](std::size_t stream_size) {
    IntegratorSettings settings;
    settings.stream_size = stream_size;
    Path path(prepared, *select_kernels("auto").value(), settings);
    std::vector<Color> radiance(rays.size());
    EXPECT_TRUE(path.trace({rays, prepared.coherence, ids.data()}, radiance.data()));
    return radiance;
  };
  const std::vector<Color> expected = traced(16384);
  for (const std::size_t size : {1, 2, 16, 100, 300}) {
    const std::vector<Color> radiance = traced(size);
    for (std::size_t k = 0; k < radiance.size(); ++k) {
      EXPECT_TRUE(same_bits(radiance[k], expected[k])) << size;
    }
  }
}

TEST(Path, StopsWhenCancelled) {
  const Scene scene = path_scene(4, 4);
  const PreparedScene prepared = prepare(scene, 4, 4, serial_for, Method::path).value();
  std::atomic<bool> cancel{true};
  IntegratorSettings settings;
  settings.cancel = &cancel;
  Path path(prepared, *select_kernels("auto").value(), settings);
  RayBuffer ray(1);
  ray.set(0, {{0, 1, 7}, {0, 0, -1}});
  const SampleId id{0, 0, 0};
  Color radiance;
  EXPECT_FALSE(path.trace({ray, Coherence::none, &id}, &radiance));
  cancel = false;
  EXPECT_TRUE(path.trace({ray, Coherence::none, &id}, &radiance));
}

}  // namespace
}  // namespace boule::test
