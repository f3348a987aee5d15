// Pictures and hits of capsules: against formulas of their own, and one way against another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/geometry.h"
#include "core/scene/instances.h"
#include "core/scene/principal_pose.h"
#include "render/integrators/sample_faults.h"
#include "render/prepare/default_camera.h"
#include "render/renderer/scene_hash.h"
#include "render/renderer/small_spheres.h"
#include "render/renderer/tracer.h"
#include "tests/render/picture_comparison.h"
#include "tests/render/renderer/measured_pictures.h"
#include "tests/support/capsule_scene.h"

namespace boule::test::capsules {
namespace {

constexpr int width = 60, height = 45;

TEST(Capsules, PicturesAreThoseOfTheReferencePath) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene scene = capsule_scene(width, height);
    scene.image.spp = method == Method::path ? 4 : 1;
    scene.render.method = method;
    expect_reference_picture(scene);
  }
}

/// One ray at a time, by the scalar path, which knows by itself where rays go on inside a capsule.
TEST(Capsules, RecordedRaysAddUpToThePicture) {
  const Scene scene = capsule_scene(width, height);
  auto renderer = Renderer::create(scene, options_of(scene)).value();
  const Image picture = renderer.render().value();
  int wrong = 0, inside = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      RayRecord record;
      ASSERT_TRUE(renderer.record_pixel(x, y, record));
      SampleFaults faults;
      wrong += same_bits(settled(record.total(), faults), picture.at(x, y)) ? 0 : 1;
      for (const RecordedRay& ray : record.rays()) {
        const bool of_capsule =
            ray.ray.source >= static_cast<std::int32_t>(scene.spheres.size() + scene.planes.size());
        inside += of_capsule && ray.ray.inside ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, 100);
}

/// A capsule twice as large in its group, turned and moved, is the capsule written out.
TEST(Capsules, GroupsAreTheCapsulesWrittenOut) {
  for (const Method method : {Method::whitted, Method::path}) {
    Scene grouped = capsule_scene(width, height);
    grouped.render.method = method;
    Group inner{"inner", {}, {}, {}, {grouped.capsules[0], grouped.capsules[1]}};
    Group outer{"outer", {}, {}, {{0, {0.1F, 0.2F, 0}, {0, 40, 0}, 0.5F, {}}}, {}};
    outer.capsules = {grouped.capsules[4]};
    grouped.groups = {inner, outer};
    grouped.instances = {{1, {-1, 0.5F, 0.25F}, {0, 0, 180}, 0.75F, {}},
                         {0, {0.5F, 0, 1}, {10, 20, 30}, 0.6F, 3U}};
    Scene flat = grouped;
    expand_instances(flat);
    ASSERT_EQ(flat.capsules.size(), grouped.capsules.size() + 1 + 2 + 2);
    EXPECT_EQ(count_primitives(grouped).capsules, flat.capsules.size());
    EXPECT_EQ(scene_hash(grouped), scene_hash(flat));
    EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
    grouped.camera.reset();
    flat.camera.reset();
    EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
  }
}

Vec3d nearest_on(const Capsule& capsule, const Vec3d& point) {
  const Vec3d a = vec_cast<double>(capsule.a), u = vec_cast<double>(capsule.b) - a;
  const double square = dot(u, u);
  return a + u * (square > 0 ? std::clamp(dot(point - a, u) / square, 0.0, 1.0) : 0.0);
}

/// Every hit of a capsule lies at its radius from the segment, with the normal of the nearest
/// point.
TEST(Capsules, HitsLieARadiusOffTheSegment) {
  const Scene scene = capsule_scene(width, height);
  Tracer tracer = Tracer::create(scene).value();
  EXPECT_EQ(tracer.primitives(), 3U + 2 + scene.capsules.size());
  std::vector<Ray> rays;
  CaseRandom random(8);
  for (int i = 0; i < 20000; ++i) {
    const Capsule& aim = scene.capsules[static_cast<std::size_t>(i) % scene.capsules.size()];
    const Vec3d a = vec_cast<double>(aim.a), b = vec_cast<double>(aim.b);
    Vec3d from = random.direction() * 9.0;
    from.y = std::fabs(from.y) + 1;  // above the floor
    from.z = std::fabs(from.z);      // and before the wall
    const Vec3d to = a + (b - a) * random.uniform(-0.1, 1.1);
    const Vec3d beside = random.direction() * (1.1 * double{aim.radius});
    rays.push_back({from, vec_cast<float>(to + beside - from)});
  }
  std::vector<TracedHit> hits(rays.size());
  std::vector<std::uint8_t> met(rays.size());
  ASSERT_TRUE(tracer.closest(rays, hits));
  ASSERT_TRUE(tracer.any(rays, met));
  std::set<std::size_t> seen;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(met[k] != 0, hits[k].id != no_primitive);
    if (hits[k].id < 5) continue;
    const auto index = static_cast<std::size_t>(hits[k].id) - 5;
    const Capsule& capsule = scene.capsules.at(index);
    const Vec3d point = rays[k].org + vec_cast<double>(rays[k].dir) * hits[k].t;
    const Vec3d outward = point - nearest_on(capsule, point);
    ASSERT_NEAR(length(outward), double{capsule.radius}, 1e-12);
    EXPECT_NEAR(dot(normalize(outward), vec_cast<double>(hits[k].normal)), 1, 1e-6);
    EXPECT_TRUE(hits[k].entering);
    seen.insert(index);
  }
  EXPECT_EQ(seen.size(), scene.capsules.size());
}

/// A capsule from x = -1 to 1 of radius 0.5 and a sphere that reaches from 1.25 to 2.25.
Scene rod_and_ball() {
  Scene scene;
  add_material(scene, Matte{});
  scene.spheres = {{{1.75F, 0, 0}, 0.5F, 0}};
  scene.capsules = {{{-1, 0, 0}, {1, 0, 0}, 0.5F, 0}};
  return scene;
}

TEST(Capsules, CrossingsAndLengthsAreExact) {
  Tracer tracer = Tracer::create(rod_and_ball()).value();
  std::vector<Ray> rays{{{-4, 0, 0}, {2, 0, 0}},     // along the axis
                        {{0.25, -3, 0}, {0, 1, 0}},  // across it
                        {{0, 0, 0}, {0, 0, 1}},      // from inside
                        {{-1, 0.5, 0}, {1, 0, 0}}};  // along the rim: a tangent of one side
  rays.push_back({{0, 0.5, 0}, {0, -1, 0}, 0});      // leaves the capsule on its inside
  rays.back().source = 1;
  rays.back().inside = true;
  const Crossings all = tracer.all_hits(rays).value();
  const std::vector<double> axis(all.t.begin(), all.t.begin() + 4);
  EXPECT_EQ(axis, (std::vector<double>{1.25, 2.625, 2.75, 3.125}));
  EXPECT_EQ(std::vector<std::int32_t>(all.id.begin(), all.id.begin() + 4),
            (std::vector<std::int32_t>{1, 0, 1, 0}));
  EXPECT_EQ(std::vector<std::uint8_t>(all.entering.begin(), all.entering.begin() + 4),
            (std::vector<std::uint8_t>{1, 1, 0, 0}));
  std::vector<std::int64_t> counts(rays.size());
  ASSERT_TRUE(tracer.count(rays, counts));
  for (std::size_t k = 0; k < rays.size(); ++k)
    EXPECT_EQ(counts[k], all.offset[k + 1] - all.offset[k]) << k;
  std::vector<double> lengths(rays.size());
  ASSERT_TRUE(tracer.chord(rays, lengths));
  EXPECT_EQ(lengths[0], 3.125 - 1.25);
  EXPECT_EQ(lengths[1], 1);
  EXPECT_EQ(lengths[2], 0.5);
  EXPECT_EQ(lengths[4], 1);
  const SphereChords chords = tracer.chords(rays).value();
  EXPECT_EQ(chords.offset[1], 2);
  EXPECT_EQ(chords.id[0], 0);
  EXPECT_EQ(chords.id[1], 1);
  EXPECT_EQ(chords.length[1], 1.5);
  std::vector<TracedHit> hits(rays.size());
  ASSERT_TRUE(tracer.closest(rays, hits));
  EXPECT_EQ(hits[4].t, 1);
  EXPECT_FALSE(hits[4].entering);
  EXPECT_FALSE(hits[2].entering);
}

/// The floor under a capsule is dark where its shadow falls, and nowhere else.
TEST(Capsules, ThrowShadows) {
  Scene scene;
  const auto white = add_material(scene, Matte{{1, 1, 1}});
  scene.image = {61, 61, 1};
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, white}};
  scene.camera = OrthographicCamera{{{5, 2, 0}, {0, -1, 0}, {0, 1, 0}}, 6};
  scene.capsules = {{{0, 1, -1}, {0, 1, 1}, 0.5F, white}};
  scene.lights = {DirectionalLight{{0, -1, 0}, {1, 1, 1}}};
  Tracer tracer = Tracer::create(scene).value();
  RenderOptions options = options_of(scene);
  options.aovs = {.position = true, .id = true};
  auto renderer = Renderer::create(scene, options).value();
  const auto channels = renderer.render_aovs().value();
  const Image picture = render(scene);
  const auto value = [&](const std::string& name, std::size_t pixel) {
    for (const ImageChannel& channel : channels) {
      if (channel.name != name) continue;
      if (const auto* ids = std::get_if<std::vector<std::uint32_t>>(&channel.samples))
        return static_cast<double>((*ids)[pixel]);
      return double{std::get<std::vector<float>>(channel.samples)[pixel]};
    }
    ADD_FAILURE() << name;
    return 0.0;
  };
  int dark = 0, lit = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (value("id", i) != 0) continue;
    const Vec3d point{value("P.X", i), 1, value("P.Z", i)};
    const double distance = length(point - nearest_on(scene.capsules[0], point));
    if (std::fabs(distance - 0.5) < 1e-4) continue;
    const bool is_dark = picture.pixels[i].r == 0;
    EXPECT_EQ(is_dark, distance < 0.5) << i;
    ++(is_dark ? dark : lit);
  }
  EXPECT_GT(dark, 30);
  EXPECT_GT(lit, 300);
}

TEST(Capsules, CropsHaveTheBytesOfThePicture) {
  const Scene scene = capsule_scene(width, height);
  const Image whole = render(scene);
  RenderOptions options = options_of(scene);
  options.crop = PixelRect{11, 9, 42, 33};
  const Image part = render(scene, options);
  int wrong = 0;
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x)
      wrong += same_bits(part.at(x, y), whole.at(x + 11, y + 9)) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

/// Cameras frame capsules as they frame the spheres around their ends.
TEST(Capsules, AreFramedByTheirEnds) {
  Scene scene;
  add_material(scene, Matte{});
  scene.capsules = {{{-3, 0.5F, 1}, {2, 1, 0}, 0.25F, 0}, {{0, 4, 0}, {1, -2, 0.5F}, 0.125F, 0}};
  Scene balls = scene;
  balls.capsules.clear();
  for (const Capsule& one : scene.capsules) {
    balls.spheres.push_back({one.a, one.radius, 0});
    balls.spheres.push_back({one.b, one.radius, 0});
  }
  for (const auto pose : {FittedPose::upright, FittedPose::principal}) {
    scene.fit.pose = balls.fit.pose = pose;
    const auto found = std::get<PinholeCamera>(default_camera(scene, 80, 60));
    const auto expected = std::get<PinholeCamera>(default_camera(balls, 80, 60));
    EXPECT_EQ(found.pose.eye, expected.pose.eye);
    EXPECT_EQ(found.pose.look_at, expected.pose.look_at);
    EXPECT_EQ(found.pose.up, expected.pose.up);
  }
  EXPECT_EQ(bounds_of(scene).low, bounds_of(balls).low);
  EXPECT_EQ(bounds_of(scene).high, bounds_of(balls).high);
  EXPECT_EQ(principal_pose(scene)->direction, principal_pose(balls)->direction);
}

/// Wires of a fifth of a pixel, in all directions, some of which come from behind the camera.
TEST(Capsules, ThinOnesStayInThePicture) {
  Scene scene;
  add_material(scene, Emissive{{1, 1, 1}});
  scene.image = {width, height, 1};
  scene.capsules = {{{-4, -3, -9}, {4, 2, -9}, 0.02F, 0},
                    {{-4, 2.5F, -9}, {4, 2.4F, -12}, 0.02F, 0},
                    {{0.5F, -1, 3}, {1, -2, -40}, 0.02F, 0},
                    {{-3, 3, -8}, {-2.5F, -30, -9}, 0.02F, 0}};
  for (const Camera& camera :
       {Camera(PinholeCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 60, FovAxis::x}),
        Camera(OrthographicCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 8}),
        Camera(FisheyeCamera{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 120, FovAxis::x})}) {
    scene.camera = camera;
    RenderOptions options = options_of(scene);
    const PreparedScene prepared = prepare(scene, width, height).value();
    const SmallSpheres small(prepared, width, {0, 0, width, height}, serial_for);
    options.spp = 256;
    const Image reference = render(scene, options);
    int marked = 0, missed = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        marked += small.may_hide(x, y) ? 1 : 0;
        missed += reference.at(x, y).r > 0 && !small.may_hide(x, y) ? 1 : 0;
      }
    }
    EXPECT_GE(marked, 60);
    EXPECT_LE(marked, 900);
    // Near the eye a wire is wider than the limit: its pixels need no mark.
    EXPECT_LE(missed, std::holds_alternative<OrthographicCamera>(camera) ? 0 : 60);
  }
}

TEST(Capsules, BadOnesAreRefusedByTheirPaths) {
  Scene scene = capsule_scene(8, 8);
  scene.capsules[3].radius = 0;
  EXPECT_EQ(validate(scene).error().key, "capsule[3].radius");
  scene.capsules[3].radius = 1;
  scene.capsules[2].b.y = NAN;
  EXPECT_EQ(validate(scene).error().key, "capsule[2].b");
  scene.capsules.resize(2);
  scene.capsules[1].material = 99;
  EXPECT_EQ(validate(scene).error().key, "capsule[1].material");
  scene.groups = {{"g", {}, {}, {}, {{{}, {}, -1, 0}}}};
  scene.capsules.clear();
  EXPECT_EQ(validate(scene).error().key, "group.g.capsule[0].radius");
  scene.groups[0].capsules[0] = {{1e30F, 0, 0}, {0, 0, 0}, 1, 0};
  scene.instances = {{0, {}, {}, 1e20F, {}}};
  EXPECT_EQ(validate(scene).error().key, "instance[0].scale");
}

}  // namespace
}  // namespace boule::test::capsules
