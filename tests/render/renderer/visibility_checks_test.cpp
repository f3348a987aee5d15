// What each pixel shows and how far it is, compared with a tracer in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/render/renderer/checked_picture.h"

namespace boule::test {
namespace {

int wrong_ids(const Scene& scene, const CheckedPicture& picture) {
  const LongDoubleTracer tracer(scene);
  int wrong = 0;
  for (std::size_t k = 0; k < picture.rays.size(); ++k)
    wrong += view_id(tracer.closest_hit(picture.rays[k])) != picture.ids[k] ? 1 : 0;
  return wrong;
}

long double ulp(float x) {
  return static_cast<long double>(std::nextafter(x, HUGE_VALF)) - static_cast<long double>(x);
}

long double error_of(const Vec3f& normal, const Vec3l& exact) {
  return length(vec_cast<long double>(normal) - exact);
}

/// The unit sphere at this distance, which fills the picture.
Scene distant_sphere(double distance) {
  Scene scene = matte_scene(160, 160);
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  const double degrees = std::asin(0.99 / distance) * 360 / elementary::pi;
  scene.camera =
      pinhole({0, 0, static_cast<float>(distance)}, {0, 0, 0}, static_cast<float>(degrees));
  light_from(scene, {0, 10, 10});
  return scene;
}

/// The largest errors of a picture's depths and normals.
struct Errors {
  long double depth = 0, curvature = 0;  ///< in ulp; curvature: the second difference of depth
  long double normal = 0;                ///< except where the surface is seen edge-on
};

Errors errors_of(const Scene& scene, const CheckedPicture& picture) {
  const LongDoubleTracer tracer(scene);
  const auto width = static_cast<std::size_t>(scene.image.width);
  Errors out;
  std::vector<long double> error(picture.rays.size(),
                                 std::numeric_limits<long double>::quiet_NaN());
  for (std::size_t k = 0; k < picture.rays.size(); ++k) {
    const LongHit hit = tracer.closest_hit(picture.rays[k]);
    if (hit.id == no_primitive || view_id(hit) != picture.ids[k]) continue;
    const float depth = picture.depths[k];
    error[k] = (static_cast<long double>(depth) - hit.distance) / ulp(depth);
    out.depth = std::max(out.depth, std::fabs(error[k]));
    if (hit.cosine > 0.1L)
      out.normal = std::max(out.normal, error_of(picture.normals[k], hit.normal));
    if (k % width < 2) continue;
    const long double second = error[k] - 2 * error[k - 1] + error[k - 2];
    if (!std::isnan(second)) out.curvature = std::max(out.curvature, std::fabs(second));
  }
  return out;
}

class WhatIsSeen : public OnEachIsa {};

// Errors of t that rise and fall along a scanline are visible as rings. The rounding to float is
// half an ulp.
TEST_P(WhatIsSeen, NoRingsOnADistantSphere) {
  for (const double distance : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    SCOPED_TRACE(distance);
    const Scene scene = distant_sphere(distance);
    const CheckedPicture picture = render_checked(scene, GetParam());
    EXPECT_EQ(wrong_ids(scene, picture), 0);
    EXPECT_GT(std::count(picture.ids.begin(), picture.ids.end(), 0U), 18000);
    const Errors errors = errors_of(scene, picture);
    EXPECT_LE(errors.depth, 0.52L);
    EXPECT_LE(errors.curvature, 2.08L);
    EXPECT_LE(errors.normal, 0x1p-24L);
  }
}

// The camera stands 2 above a ground sphere; its horizon is 2000 away.
TEST_P(WhatIsSeen, TheHorizonOfAGroundSphere) {
  for (const float fov : {60.0f, 1.0f, 0.01f, 1e-4f}) {
    SCOPED_TRACE(fov);
    Scene scene = matte_scene(256, 192);
    scene.spheres = {{{0, -1e6f, 0}, 1e6f, 0}};
    light_from(scene, {0, 10, 0});
    scene.camera = pinhole({0, 2, 0}, {0, 0, -1000}, fov);
    const CheckedPicture picture = render_checked(scene, GetParam());
    EXPECT_EQ(wrong_ids(scene, picture), 0);
    const auto sky = std::count(picture.ids.begin(), picture.ids.end(), no_aov_id);
    EXPECT_GT(sky, 256 * 48);
    EXPECT_LT(sky, 256 * 144);
    int turns = 0;  // changes from sky to ground or back, down the columns
    for (std::size_t k = 256; k < picture.ids.size(); ++k)
      turns += picture.ids[k] != picture.ids[k - 256] ? 1 : 0;
    EXPECT_EQ(turns, 256);
  }
}

/// Spheres about as large as a pixel. Every fourth is anywhere; the rims of the others are 2^-k
/// radii from a pixel's centre.
Scene speck_scene(int count, float fov) {
  Scene scene = matte_scene(128, 96);
  scene.camera = pinhole({0, 0, 0}, {0, 0, -1}, fov);
  light_from(scene, {0, 0, 0});
  const LongPinhole camera(std::get<PinholeCamera>(*scene.camera), scene.image);
  const double pixel = static_cast<double>(length(camera.right)) * 2 / 128;
  CaseRandom random(401);
  for (int i = 0; i < count; ++i) {
    const int x = random.below(128);
    const int y = random.below(96);
    const double far = random.decade(0, 4);
    const double r = far * pixel * random.uniform(0.3, 1.5);
    const Vec3d h = vec_cast<double>(camera.direction(x + 0.5L, y + 0.5L));
    const Vec3d across = random.perpendicular(h);
    const double rim = random.sign() * std::exp2(-4 - random.below(21));
    const double beside = i % 4 == 0 ? random.uniform(0, 2) : 1 + rim;
    scene.spheres.push_back(
        {vec_cast<float>(h * far + across * (r * beside)), static_cast<float>(r), 0});
  }
  return scene;
}

// Few spheres are scanned, many are put in a tree.
TEST_P(WhatIsSeen, SilhouettesOfAPixel) {
  for (const int count : {24, 1500}) {
    for (const float fov : {40.0f, 1.0f, 0.02f, 1e-3f}) {
      SCOPED_TRACE(testing::Message() << count << " spheres, fov " << fov);
      const Scene scene = speck_scene(count, fov);
      const CheckedPicture picture = render_checked(scene, GetParam());
      EXPECT_EQ(wrong_ids(scene, picture), 0);
      const auto sky = std::count(picture.ids.begin(), picture.ids.end(), no_aov_id);
      EXPECT_GT(128 * 96 - sky, count);
      EXPECT_GT(sky, 128 * 48);
    }
  }
}

/// Concentric shells from radius 1 on, 4e-5 apart, in random order of their ids.
constexpr std::uint32_t outermost = 2, innermost = 3;
Scene shell_scene() {
  Scene scene = matte_scene(160, 120);
  for (const int place : {3, 1, 5, 0, 4, 2})
    scene.spheres.push_back({{0, 0, 0}, 1 + 4e-5f * static_cast<float>(place), 0});
  light_from(scene, {0, 0, 0});
  return scene;
}

/// Whether the picture shows something, and nothing with another id.
void expect_all(const CheckedPicture& picture, std::uint32_t id) {
  const auto all = static_cast<std::ptrdiff_t>(picture.ids.size());
  const auto those = std::count(picture.ids.begin(), picture.ids.end(), id);
  const auto sky = std::count(picture.ids.begin(), picture.ids.end(), no_aov_id);
  EXPECT_EQ(those + sky, all);
  EXPECT_GT(those, all / 4);
}

TEST_P(WhatIsSeen, TheNearestOfShells) {
  const PinholeCamera outside[] = {
      pinhole({0, 0, 3}, {0, 0, 0}, 45),           // shows them whole
      pinhole({0, 0, 3}, {1, 0, 0}, 20),           // the picture's edge cuts them
      pinhole({0, 0.5f, 2000}, {0, 0, 0}, 0.05f),  // float cannot tell them apart from here
      pinhole({0, 0, 10}, {1, 0, 0}, 1e-2f),       // the rim: the shells fan out
      pinhole({0, 0, 1.0003f}, {0.5f, 0, 0}, 90)};
  for (const PinholeCamera& camera : outside) {
    SCOPED_TRACE(camera.pose.eye.z);
    Scene scene = shell_scene();
    scene.camera = camera;
    const CheckedPicture picture = render_checked(scene, GetParam());
    EXPECT_EQ(wrong_ids(scene, picture), 0);
    expect_all(picture, outermost);
  }
  for (const Vec3f& eye : {Vec3f{0, 0, 0.1f}, {0, 0, 0.99999f}, {0.6f, 0.7f, 0.3f}}) {
    Scene scene = shell_scene();
    scene.camera = pinhole(eye, {0, 0.3f, 0}, 100);
    const CheckedPicture picture = render_checked(scene, GetParam());
    EXPECT_EQ(wrong_ids(scene, picture), 0);
    expect_all(picture, innermost);
  }
}

// From between two shells one is visible below and the other above. A plane cuts them open.
TEST_P(WhatIsSeen, ShellsFromInsideAndCutOpen) {
  Scene between = shell_scene();
  between.camera = pinhole({0, 1.0001f, 0}, {1, 1.0001f, 0}, 60);
  const CheckedPicture gap = render_checked(between, GetParam());
  EXPECT_EQ(wrong_ids(between, gap), 0);
  for (const std::uint32_t id : {0U, 5U})
    EXPECT_GT(std::count(gap.ids.begin(), gap.ids.end(), id), 1000) << id;
  for (const float fov : {45.0f, 1.0f, 0.01f}) {
    Scene cut = shell_scene();
    cut.planes = {{{0, 0, 0}, {0, 1, 0.25f}, 0}};
    cut.camera = pinhole({0.3f, 2, 5}, {1, 0, 0}, fov);
    EXPECT_EQ(wrong_ids(cut, render_checked(cut, GetParam())), 0) << fov;
  }
}

/// The scene with every length times 2^k, and with lights with falloff so much stronger.
Scene times_power_of_two(Scene scene, int k) {
  const float s = std::ldexp(1.0f, k);
  for (Sphere& sphere : scene.spheres) sphere.center = sphere.center * s, sphere.radius *= s;
  for (Plane& plane : scene.planes) plane.point = plane.point * s;
  for (Light& light : scene.lights) {
    auto* point = std::get_if<PointLight>(&light);
    if (point == nullptr) continue;
    point->position = point->position * s;
    if (point->falloff == Falloff::inverse_square) point->intensity = point->intensity * (s * s);
  }
  std::visit([&](auto& c) { c.pose.eye = c.pose.eye * s, c.pose.look_at = c.pose.look_at * s; },
             *scene.camera);
  if (auto* parallel = std::get_if<OrthographicCamera>(&*scene.camera)) parallel->height *= s;
  return scene;
}

int differing_depths(const CheckedPicture& a, const CheckedPicture& b, int k) {
  int count = 0;
  for (std::size_t i = 0; i < a.depths.size(); ++i)
    count += std::bit_cast<std::uint32_t>(std::ldexp(a.depths[i], k)) !=
                     std::bit_cast<std::uint32_t>(b.depths[i])
                 ? 1
                 : 0;
  return count;
}

// No length is special: in a scene with glass, mirrors and all lights the colours have the same
// bits.
TEST_P(WhatIsSeen, TheSameAtAnyScale) {
  Scene perspective = mixed_scene(64, 48), parallel = perspective;
  parallel.camera = OrthographicCamera{{{2, 4, 6}, {0, 0.5f, 0}, {0, 1, 0}}, 6};
  for (const Scene& scene : {perspective, parallel}) {
    const CheckedPicture plain = render_checked(scene, GetParam());
    EXPECT_EQ(wrong_ids(scene, plain), 0);
    for (int k = -20; k <= 20; ++k) {
      const CheckedPicture scaled = render_checked(times_power_of_two(scene, k), GetParam());
      EXPECT_EQ(scaled.ids, plain.ids) << k;
      EXPECT_EQ(differing_depths(plain, scaled, k), 0) << k;
      EXPECT_EQ(differing_pixels(plain.image, scaled.image), 0) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, WhatIsSeen, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
