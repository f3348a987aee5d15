// Pictures and hits of groups and their instances, compared with those of the scene written out.
#include "core/scene/instances.h"

#include <gtest/gtest.h>

#include "render/renderer/scene_hash.h"
#include "render/renderer/tracer.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/grouped_scene.h"

namespace boule::test {
namespace {

TEST(Instances, MatchTheExpandedScene) {
  const Scene grouped = grouped_scene();
  EXPECT_TRUE(validate(grouped));
  Scene flat = grouped;
  expand_instances(flat);
  EXPECT_EQ(flat.spheres.size(), 3u + 3 + 2 + 3);
  EXPECT_EQ(count_primitives(grouped).spheres, flat.spheres.size());
  EXPECT_EQ(count_primitives(grouped).planes, flat.planes.size());
  EXPECT_EQ(scene_hash(grouped), scene_hash(flat));
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
  Scene framed = grouped;  // without a camera: framed on what the instances show
  framed.camera.reset();
  flat.camera.reset();
  EXPECT_EQ(differing_pixels(render(framed), render(flat)), 0);

  std::vector<Ray> rays;
  CaseRandom random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3d from = random.direction() * 6.0, to = random.direction();
    rays.push_back({from, vec_cast<float>(to - from)});
  }
  std::vector<TracedHit> a(rays.size()), b(rays.size());
  EXPECT_TRUE(Tracer::create(grouped).value().closest(rays, a));
  EXPECT_TRUE(Tracer::create(flat).value().closest(rays, b));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(a[i].t == b[i].t && a[i].id == b[i].id && a[i].normal == b[i].normal);
  }
}

TEST(Instances, MatchForAnyIsaThreadsAndTiles) {
  Scene flat = grouped_scene();
  expand_instances(flat);
  const Image expected = render(flat);
  for (const char* isa : {"scalar", "auto"}) {
    for (const unsigned threads : {1u, 3u}) {
      RenderOptions options = options_of(flat);
      options.isa = isa;
      options.threads = threads;
      options.tile = threads == 1 ? 7 : 0;
      EXPECT_EQ(differing_pixels(render(grouped_scene(), options), expected), 0);
    }
  }
}

TEST(Instances, PathsSeeTheLampsInGroups) {
  Scene grouped = grouped_scene();
  grouped.groups[1].spheres[0].material = 4;  // the lamp
  grouped.image.spp = 4;
  grouped.render.method = Method::path;
  Scene flat = grouped;
  expand_instances(flat);
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
}

/// All AOVs of a scene.
std::vector<ImageChannel> aovs_of(const Scene& scene) {
  RenderOptions options = options_of(scene);
  options.aovs = {true, true, true, true, true};
  auto renderer = Renderer::create(scene, options);
  EXPECT_TRUE(renderer);
  return std::move(renderer.value().render_aovs()).value();
}

void expect_the_same_pictures(const Scene& grouped, const Scene& flat) {
  EXPECT_EQ(differing_pixels(render(grouped), render(flat)), 0);
  const auto found = aovs_of(grouped), expected = aovs_of(flat);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i].samples == expected[i].samples) << found[i].name;
}

TEST(Instances, SharedGroupsMatchInPicturesAndAovs) {
  Scene grouped = shared_scene();
  ASSERT_TRUE(groups_to_share(grouped));
  Scene flat = grouped;
  expand_instances(flat);
  ASSERT_FALSE(groups_to_share(flat));
  EXPECT_GT(flat.spheres.size(), 150'000U);
  expect_the_same_pictures(grouped, flat);
  grouped.render.method = flat.render.method = Method::path;  // with lamps in groups
  grouped.image.spp = flat.image.spp = 3;
  expect_the_same_pictures(grouped, flat);
}

TEST(Instances, SharedGroupsMatchInFramingAndLight) {
  Scene grouped = shared_scene();
  grouped.camera.reset();
  grouped.lights.clear();
  grouped.background = ConstantBackground{};
  grouped.materials[4].material = Matte{};  // no lamp
  Scene flat = grouped;
  expand_instances(flat);
  expect_the_same_pictures(grouped, flat);
}

TEST(Instances, SharedGroupsMatchInTracedRays) {
  const Scene grouped = shared_scene();
  Scene flat = grouped;
  expand_instances(flat);
  std::vector<Ray> rays;
  CaseRandom random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d from = random.direction() * 4.0, to = random.direction() * 2.0;
    rays.push_back({from, vec_cast<float>(to - from)});
  }
  for (const Solver solver : {Solver::robust, Solver::fast}) {
    TraceOptions options;
    options.solver = solver;
    std::vector<TracedHit> a(rays.size()), b(rays.size());
    EXPECT_TRUE(Tracer::create(grouped, options).value().closest(rays, a));
    EXPECT_TRUE(Tracer::create(flat, options).value().closest(rays, b));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_TRUE(a[i].t == b[i].t && a[i].id == b[i].id && a[i].normal == b[i].normal) << i;
    }
  }
}

/// 3 x 10^9 spheres, whose ids are beyond 31 bits and whose slots are too, are shown as the one of
/// 30,000 copies that the camera sees.
struct ManyCopies {
  static constexpr std::uint32_t copies = 30'000, spheres = 100'000;
  Scene one = empty_scene(40, 30), many;

  ManyCopies();
};

ManyCopies::ManyCopies() {
  one.lights = {DirectionalLight{{0.1f, 0.2f, -1}, {1, 1, 1}}};
  Group swarm{"swarm", {}, {}, {}};
  CaseRandom random(14);
  for (std::uint32_t i = 0; i < spheres; ++i) {
    const Vec3d at = random.direction() * random.uniform(0.2, 1);
    swarm.spheres.push_back({vec_cast<float>(at), 0.01F, 0});
  }
  add_material(one, Matte{{0.7f, 0.3f, 0.2f}});
  one.groups = {swarm};
  many = one;
  for (std::uint32_t i = 0; i < copies; ++i) {
    const auto x = static_cast<float>(3 * (i % 200)), y = static_cast<float>(3 * (i / 200));
    many.instances.push_back({0, {x, y, 0}, {20, 0, static_cast<float>(i % 360)}, 1, {}});
  }
}

TEST(Instances, ThreeBillionSpheresMatchOneCopy) {
  constexpr std::uint32_t copies = ManyCopies::copies, spheres = ManyCopies::spheres;
  auto [one, many] = ManyCopies();
  EXPECT_EQ(count_primitives(many).total(), 3'000'000'000U);
  for (const std::uint32_t shown : {0U, 21'474U, copies - 1}) {  // 2^31 is amid the second
    const Vec3f at = many.instances[shown].translate;
    one.instances = {many.instances[shown]};
    one.camera = many.camera = pinhole({at.x, at.y, 2.5F}, at, 40);
    EXPECT_EQ(differing_pixels(render(many), render(one)), 0);
    const auto found = aovs_of(many), expected = aovs_of(one);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto* ids = std::get_if<std::vector<std::uint32_t>>(&found[i].samples);
      if (ids == nullptr) {
        EXPECT_TRUE(found[i].samples == expected[i].samples) << found[i].name;
        continue;
      }
      const auto& own = std::get<std::vector<std::uint32_t>>(expected[i].samples);
      for (std::size_t k = 0; k < own.size(); ++k) {
        const bool hit = own[k] < spheres;
        hits += hit ? 1U : 0U;
        ASSERT_EQ((*ids)[k], hit ? own[k] + shown * spheres : own[k]) << k;
      }
    }
    EXPECT_GT(hits, 500U);
  }
}

TEST(Instances, IdsBeyond31BitsNeedUnsignedOutput) {
  const Scene many = ManyCopies().many;
  const auto refused = Tracer::create(many);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().key, "instance");
  EXPECT_EQ(refused.error().message,
            "shows more than 2147483647 primitives: hits of rays have no ids for them");
  RenderOptions judged = options_of(many);
  judged.solver = Solver::reference;
  const auto listed = Renderer::create(many, judged);
  ASSERT_FALSE(listed);
  EXPECT_EQ(listed.error().message,
            "shows more than 2147483647 primitives: solver reference has no ids for them");
}

/// A scene of particles in their cell, and images of it, instances from so many spheres on.
Scene replicated_scene(const std::string& keys, std::uint64_t fewest) {
  SceneFolder files;
  std::string text = "5000\nLattice=\"9 0 0 1 8 0 0 0 7\" Properties=species:S:1:pos:R:3\n";
  CaseRandom random(15);
  for (int i = 0; i < 5000; ++i) {
    text += i % 2 == 0 ? "C" : "O";
    for (const double side : {9.0, 8.0, 7.0}) text += " " + std::to_string(random.uniform(0, side));
    text += "\n";
  }
  static_cast<void>(files.write("cell.xyz", text));
  SceneFileOptions options;
  options.fewest_shared = fewest;
  return files
      .load("scene.toml",
            "schema = 1\n[image]\nsize = [48, 36]\n[[particles]]\nfile = "
            "\"cell.xyz\"\nreplicate = [3, 4, 3]\n" +
                keys,
            options)
      .value()
      .scene;
}

TEST(Instances, ReplicatedParticlesMatchTheExpandedScene) {
  const Scene shared = replicated_scene("", 0), listed = replicated_scene("", 180'001);
  EXPECT_TRUE(groups_to_share(shared));
  EXPECT_TRUE(listed.instances.empty());
  Scene flat = shared;
  expand_instances(flat);
  EXPECT_EQ(differing_pixels(render(shared), render(flat)), 0);
  // Rounded once more than those that are listed: half a step in the group, half a step of the
  // shift, half a step where it is shown; coordinates are below 32.
  ASSERT_EQ(flat.spheres.size(), listed.spheres.size());
  for (std::size_t i = 0; i < flat.spheres.size(); ++i) {
    const Sphere &a = flat.spheres[i], &b = listed.spheres[i];
    const Vec3f off = a.center - b.center;
    const float most = std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
    ASSERT_LE(most, 3 * 0x1p-20F) << i;
    ASSERT_TRUE(a.radius == b.radius && a.material == b.material) << i;
  }
}

/// Their bonds, too; the edges of the cell are those of all images together.
TEST(Instances, ReplicatedBondsMatchTheExpandedScene) {
  const std::string keys = "style = \"sticks\"\nbonds = 0.3\ncell_edges = true\n";
  const Scene shared = replicated_scene(keys, 0), listed = replicated_scene(keys, 180'001);
  EXPECT_TRUE(groups_to_share(shared));
  EXPECT_EQ(shared.capsules.size(), 12U);
  ASSERT_EQ(shared.groups.size(), 1U);
  EXPECT_GT(shared.groups[0].capsules.size(), 1000U);
  Scene flat = shared;
  expand_instances(flat);
  EXPECT_GT(flat.capsules.size(), 36U * 1000);
  EXPECT_GE(flat.capsules.size(), listed.capsules.size());  // where images meet, bonds are whole
  EXPECT_EQ(differing_pixels(render(shared), render(flat)), 0);
}

/// What is repeated on faces stands beside the instances.
TEST(Instances, BoundaryParticlesMatchTheExpandedScene) {
  const std::string keys = "boundary = true\n";
  const Scene shared = replicated_scene(keys, 0), listed = replicated_scene(keys, 180'001);
  EXPECT_TRUE(groups_to_share(shared));
  EXPECT_GT(shared.spheres.size(), 100U);
  ASSERT_EQ(shared.spheres.size() + 180'000, listed.spheres.size());
  for (std::size_t i = 0; i < shared.spheres.size(); ++i) {
    EXPECT_EQ(shared.spheres[i].center, listed.spheres[180'000 + i].center) << i;
    EXPECT_EQ(shared.spheres[i].radius, listed.spheres[180'000 + i].radius) << i;
  }
}

/// What is shared is hashed as it is: everything that a picture depends on counts.
TEST(Instances, HashesCoverSharedGroupsAndTheirPlaces) {
  const Scene scene = shared_scene();
  Scene moved = scene, resized = scene, fewer = scene;
  moved.instances.back().translate.x += 1;
  resized.groups[2].spheres[17].radius *= 2;
  fewer.instances.pop_back();
  for (const Scene& other : {moved, resized, fewer})
    EXPECT_NE(scene_hash(other), scene_hash(scene));
  EXPECT_EQ(scene_hash(shared_scene()), scene_hash(scene));
}

}  // namespace
}  // namespace boule::test
