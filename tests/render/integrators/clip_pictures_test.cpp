// Pictures of spheres and capsules that planes cut.
#include <gtest/gtest.h>

#include <cmath>

#include "render/integrators/aovs.h"
#include "tests/render/integrators/cut_scenes.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/renderer/measured_pictures.h"
#include "tests/support/capsule_scene.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::clips {
namespace {

TEST(Clips, AovsAreThoseOfLongDouble) {
  int unsure = 0, caps = 0, hits = 0;
  for (std::uint64_t seed = 100; seed < 124; ++seed) {
    const Scene scene = cut_scene(seed, 1 + static_cast<int>(seed % 3));
    const auto prepared = prepare(scene, 8, 8);
    ASSERT_TRUE(prepared);
    const std::vector<Ray> rays = rays_through(seed, 1500);
    AovTracer tracer(prepared.value(), *select_kernels("auto").value(), Solver::robust);
    RayBuffer stream = to_stream(rays);
    std::vector<Aovs> aovs(rays.size());
    tracer.trace(stream, Coherence::none, aovs.data());
    for (std::size_t k = 0; k < rays.size(); ++k) {
      Ray ray = rays[k];
      ray.tmax = float_above(ray.tmax);
      const CutJudge judge(scene, ray);
      const Judged& expected = judge.nearest();
      if (expected.doubt < 1e-6L) {
        ++unsure;
        continue;
      }
      ASSERT_EQ(aovs[k].id, static_cast<std::uint32_t>(expected.id)) << seed << ": " << k;
      if (expected.id == no_primitive) continue;
      ++hits;
      const auto away = static_cast<double>(expected.distance);
      EXPECT_NEAR(static_cast<double>(aovs[k].depth), away, 1e-6 * std::max(away, 1.0));
      const Vec3l normal = vec_cast<long double>(aovs[k].normal);
      EXPECT_LT(length(normal - expected.normal), 1e-3L) << seed << ": " << k;
      for (const Clip& clip : scene.clips) {
        const Vec3l n = unit(vec_cast<long double>(clip.normal));
        caps += length(normal - n) < 1e-6L ? 1 : 0;
      }
    }
  }
  EXPECT_LT(unsure, 400);
  EXPECT_GT(hits, 8000);
  EXPECT_GT(caps, 2000);
}

/// The scene of all materials, with capsules, cut through the middle of its glass.
Scene cut_picture(Method method) {
  Scene scene = capsule_scene(60, 45);
  scene.render.method = method;
  scene.image.spp = method == Method::path ? 4 : 1;
  scene.clips = {{{0, 0, 0.7F}, {0.1F, 0, 1}}, {{2, 0, 0}, {1, 0.2F, 0}}};
  return scene;
}

TEST(Clips, PicturesAreThoseOfTheReferencePath) {
  for (const Method method : {Method::whitted, Method::path}) {
    const Scene scene = cut_picture(method);
    expect_reference_picture(scene);
    Scene whole = scene;
    whole.clips.clear();
    EXPECT_GT(differing_pixels(render(whole), render(scene)), 300);
  }
}

/// A part of a picture is that part of it, by samples of any number.
TEST(Clips, AdaptiveSamplesAndCropsAgree) {
  for (const Method method : {Method::whitted, Method::path}) {
    const Scene scene = cut_picture(method);
    RenderOptions options = options_of(scene);
    const Image picture = render(scene, options);
    const PixelRect part{20, 12, 44, 36};
    RenderOptions cropped = options;
    cropped.crop = PixelRect{16, 8, 48, 40};
    cropped.threads = 3;
    const Image some = render(scene, cropped);
    for (int y = part.y0; y < part.y1; ++y) {
      for (int x = part.x0; x < part.x1; ++x)
        EXPECT_TRUE(same_bits(some.at(x - 16, y - 8), picture.at(x, y)));
    }
    const bool is_path = method == Method::path;
    for (RenderOptions* each : {&options, &cropped}) {
      (is_path ? each->noise : each->aa) = is_path ? 0.02F : 4;
      each->min_spp = 16;
      each->spp = 32;
    }
    const MeasuredPicture whole = measured(scene, options);
    EXPECT_EQ(hash_of(measured(scene, cropped), part), hash_of(whole, part));
  }
}

/// One ray at a time, which knows by itself where rays go on.
TEST(Clips, RecordedRaysAddUpToThePicture) {
  const Scene scene = cut_picture(Method::whitted);
  auto renderer = Renderer::create(scene, options_of(scene)).value();
  const Image picture = renderer.render().value();
  int wrong = 0, from_caps = 0;
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 60; ++x) {
      RayRecord record;
      ASSERT_TRUE(renderer.record_pixel(x, y, record));
      SampleFaults faults;
      wrong += same_bits(settled(record.total(), faults), picture.at(x, y)) ? 0 : 1;
      for (const RecordedRay& ray : record.rays()) {
        const auto source = static_cast<std::size_t>(ray.ray.source);
        from_caps += source == 5 || source == 6 ? 1 : 0;  // 3 spheres, 2 planes
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(from_caps, 300);
}

TEST(Clips, WhatIsCutOffIsNotThere) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene scene = capsule_scene(60, 45);
    scene.render.method = method;
    scene.image.spp = 2;
    const Scene without = scene;
    const auto lamp = static_cast<std::uint32_t>(4);
    scene.spheres.push_back({{-40, 2, 1}, 1, lamp});
    scene.clips = {{{-30, 0, 0}, {-1, 0, 0}}};
    EXPECT_EQ(differing_pixels(render(scene), render(without)), 0);
  }
}

TEST(Clips, PlaneThatCutsNothingChangesNothing) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene scene = capsule_scene(60, 45);
    scene.render.method = method;
    scene.image.spp = 2;
    scene.spheres.push_back({{-2, 3, 1}, 0.5F, 4});  // a lamp, which paths sample
    const Image whole = render(scene);
    scene.clips = {{{0, 0, 30}, {0.1F, 0.2F, 1}}, {{0, 30, 0}, {0, 1, 0}}};
    EXPECT_EQ(differing_pixels(render(scene), whole), 0);
  }
}

/// Half a ball of glass, its flat side to the light: a ray is bent at both sides as Snell says.
TEST(Clips, GlassIsBentAtTheCap) {
  Scene scene = empty_scene(9, 9);
  add_material(scene, Glass{{1, 1, 1}, 1.5F});
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.clips = {{{0, 0, 0}, {0, 0, 1}}};
  scene.camera = pinhole({2, 0, 3}, {0.25F, 0, 0}, 1);
  auto renderer = Renderer::create(scene, options_of(scene)).value();
  RayRecord record;
  ASSERT_TRUE(renderer.record_pixel(4, 4, record));
  const Vec3d view = normalize(Vec3d{-1.75, 0, -3});
  const double sine = -view.x / 1.5;  // within the glass
  const RecordedRay* in = nullptr;
  for (const RecordedRay& ray : record.rays()) {
    if (in == nullptr && ray.kind == RayKind::refraction) in = &ray;
  }
  ASSERT_NE(in, nullptr);
  EXPECT_NEAR(in->ray.org.x, 0.25, 1e-6);
  EXPECT_NEAR(in->ray.org.z, 0, 1e-6);
  const Vec3d bent{-sine, 0, -std::sqrt(1 - sine * sine)};
  EXPECT_LT(length(normalize(vec_cast<double>(in->ray.dir)) - bent), 1e-6);
  // It leaves the ball behind, where |o + t d| = 1.
  const double b = 0.25 * bent.x;
  EXPECT_NEAR(in->hit.t * length(vec_cast<double>(in->ray.dir)),
              -b + std::sqrt(b * b - (0.0625 - 1)), 1e-5);
}

/// The shadow on the floor is that of what is left; the floor itself is whole.
TEST(Clips, FloorIsWholeAndShadowsAreCut) {
  Scene scene = empty_scene(9, 9);
  add_material(scene, Matte{});
  scene.spheres = {{{0, 1, 0}, 1, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
  scene.lights = {DirectionalLight{{0, -1, 0}, {1, 1, 1}}};
  scene.clips = {{{0, 0, 0}, {1, 0, 0}}};
  scene.camera = pinhole({0.5F, 0.5F, 4}, {0.5F, 0, 0}, 1);
  const Color lit = render(scene).at(4, 4);
  EXPECT_GT(lit.r, 0.1F);
  scene.camera = pinhole({-0.5F, 0.1F, 4}, {-0.5F, 0, 0}, 1);
  EXPECT_EQ(render(scene).at(4, 4).r, 0);
}

}  // namespace
}  // namespace boule::test::clips
