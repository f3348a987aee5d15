// The comparison of pictures bites: each mistake that a peer's scene file could contain is made in
// Boule's scene here, and even the widest tolerance of any peer notices it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "bench/peers/frames/frame_pictures.h"
#include "bench/peers/frames/frame_programs.h"
#include "bench/peers/frames/frame_scene.h"
#include "render/files/scene_file/scene_file.h"
#include "render/renderer/renderer.h"
#include "tests/support/temp_dir.h"

namespace boule::bench {
namespace {

Scene flake() {
  const test::TempDir folder;
  const std::string path = (folder.path() / "flake.nff").string();
  std::ofstream(path) << as_nff(make_flake("flake3").value());
  auto loaded = load_scene(path, {});
  return std::move(loaded).value().scene;
}

Image picture(const Scene& scene, int bounces = frame_bounces) {
  RenderOptions options = options_of(scene);
  options.width = options.height = 256;
  options.max_depth = bounces;
  auto renderer = Renderer::create(scene, options);
  auto image = renderer.value().render();
  for (Color& c : image.value().pixels) {
    c = {std::min(c.r, 1.0F), std::min(c.g, 1.0F), std::min(c.b, 1.0F)};
  }
  return std::move(image).value();
}

void expect_noticed(const Scene& wrong, const char* what, int bounces = frame_bounces) {
  const Difference difference =
      compare_pictures(picture(flake()), picture(wrong, bounces), beyond_tachyons_last_mirror());
  EXPECT_FALSE(within(difference, tachyon_tolerance))
      << what << ": " << difference.mean << " " << difference.share;
}

Phong& ball_of(Scene& scene) { return std::get<Phong>(scene.materials.at(1).material); }

TEST(FramePictures, EqualOnesDoNotDiffer) {
  const Difference difference = compare_pictures(picture(flake()), picture(flake()), gray(0.1F));
  EXPECT_EQ(difference.mean, 0);
  EXPECT_EQ(difference.share, 0);
}

TEST(FramePictures, OfOtherSizesDifferInAll) {
  EXPECT_EQ(compare_pictures(Image(2, 2), Image(2, 3), {}).share, 1);
}

TEST(FramePictures, AHabitIsExcusedWhereItIsMeant) {
  Image ours(2, 1), theirs(2, 1);
  ours.pixels = {gray(0.5F), gray(0.5F)};
  theirs.pixels = {gray(0.75F), gray(0.25F)};
  const Difference difference = compare_pictures(ours, theirs, gray(0.25F));
  EXPECT_EQ(difference.share, 0.5);
  EXPECT_EQ(difference.mean, 0.125);
}

TEST(FramePictures, AWrongViewIsNoticed) {
  for (const float fov : {44.0F, 46.0F}) {
    Scene scene = flake();
    std::get<PinholeCamera>(*scene.camera).fov = fov;
    expect_noticed(scene, "fov");
  }
  Scene mirrored = flake();
  for (Sphere& sphere : mirrored.spheres) sphere.center.x = -sphere.center.x;
  expect_noticed(mirrored, "mirrored");
}

TEST(FramePictures, AMissingOrMovedLightIsNoticed) {
  for (std::size_t i = 0; i < 3; ++i) {
    Scene scene = flake();
    scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(i));
    expect_noticed(scene, "light");
  }
  Scene moved = flake();
  std::get<PointLight>(moved.lights[0]).position.z += 1;
  expect_noticed(moved, "moved light");
}

/// The floor without the balls' shadows and mirror images, the balls unchanged.
TEST(FramePictures, MissingShadowsAreNoticed) {
  Scene bare = flake();
  bare.spheres.resize(1);
  bare.spheres[0].radius = 1e-6F;
  const Image floor = picture(bare), shadowed = picture(flake());
  RenderOptions options = options_of(flake());
  options.width = options.height = shadowed.width;
  options.aovs.id = true;
  auto renderer = Renderer::create(flake(), options);
  const auto aovs = renderer.value().render_aovs();
  const auto& ids = std::get<std::vector<std::uint32_t>>(aovs.value().at(0).samples);
  Image unshadowed = shadowed;
  const std::size_t plane = flake().spheres.size();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == plane) unshadowed.pixels[i] = floor.pixels[i];
  }
  const Difference difference =
      compare_pictures(shadowed, unshadowed, beyond_tachyons_last_mirror());
  EXPECT_FALSE(within(difference, tachyon_tolerance)) << difference.mean << difference.share;
}

TEST(FramePictures, WrongMaterialsAndDepthsAreNoticed) {
  expect_noticed(flake(), "no mirror", 0);
  Scene dull = flake();
  ball_of(dull).ks = 0;
  expect_noticed(dull, "ks");
  Scene dark = flake();
  ball_of(dark).kd = 0.25F;
  expect_noticed(dark, "kd");
  Scene sharp = flake();
  ball_of(sharp).shininess = 30;
  expect_noticed(sharp, "shininess");
}

}  // namespace
}  // namespace boule::bench
